#include <limits>
#include <map>

#include "scene/choices.hpp"
#include "scene/scene_keys.hpp"

namespace vitrum::scene::keys {
namespace {

/// The numbers of a model's describe() table followed by its keys of other kinds.
template <class Parameters>
std::vector<KeyInfo> model_keys(std::initializer_list<KeyInfo> others) {
  std::vector<KeyInfo> keys = parameter_keys<Parameters>();
  keys.insert(keys.end(), others);
  return keys;
}

}  // namespace

KeyTable material() {
  static const std::vector<KeyInfo> keys = [] {
    std::vector<KeyInfo> list = model_keys<ElasticParameters>({
        other_key("damage", "a table", "rate-dependent tensile damage; absent: none"),
        other_key("drucker_prager", "a table", "plasticity under compression; absent: none"),
        other_key("von_mises", "a table",
                  "plasticity with hardening and softening; absent: none; excludes `drucker_prager`"),
        other_key("decohesion", "a table", "from localisation to separation; absent: none"),
    });
    for (const RegisteredLaw& law : registered_laws())
      list.push_back(other_key(law.table, "a table", law.text + "; excludes the models above"));
    return list;
  }();
  return keys;
}

KeyTable law(const RegisteredLaw& law) {
  static std::map<std::string, std::vector<KeyInfo>> tables;
  std::vector<KeyInfo>& keys = tables[law.table];
  if (keys.empty())
    for (const ParameterRow& row : law.parameters) {
      KeyInfo key = row.is_list ? numbers_key(row.name, row.bounds, row.unit, row.description)
                                : number_key(row.name, row.bounds, row.unit, row.description);
      keys.push_back(row.fallback ? defaulted(std::move(key), *row.fallback) : required(std::move(key)));
    }
  return keys;
}

KeyTable damage() {
  static const std::vector<KeyInfo> keys = [] {
    KeyInfo rate = choice_key("rate", rate_names, "strain rate that enters eq. 7");
    rate.expected = "\"running-maximum\" or a table {fixed = RATE}";
    return model_keys<DamageParameters>({defaulted(std::move(rate), "\"running-maximum\"")});
  }();
  return keys;
}

KeyTable fixed_rate() {
  static const std::vector<KeyInfo> keys{
      required(number_key("fixed", {0.0, std::numeric_limits<double>::infinity(), true, true}, "1/s",
                          "this rate enters eq. 7 whatever the history")),
  };
  return keys;
}

KeyTable drucker_prager() {
  static const std::vector<KeyInfo> keys = model_keys<DruckerPragerParameters>({
      defaulted(choice_key("flow", flow_names,
                           "plastic flow without volume change, or normal to the yield surface"),
                "\"isochoric\""),
  });
  return keys;
}

KeyTable von_mises() {
  static const std::vector<KeyInfo> keys = model_keys<VonMisesParameters>({});
  return keys;
}

KeyTable decohesion() {
  static const std::vector<KeyInfo> keys = model_keys<DecohesionParameters>({
      defaulted(choice_key("plane", plane_names,
                           "normals searched: in the plane of the scene, or the hoop direction too"),
                "\"in-plane\""),
  });
  return keys;
}

}  // namespace vitrum::scene::keys
