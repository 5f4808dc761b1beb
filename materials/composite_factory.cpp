#include <stdexcept>

#include "materials/composite_batch.hpp"
#include "materials/composite_intact.hpp"
#include "materials/composite_jumps.hpp"
#include "materials/composite_localised.hpp"
#include "materials/composite_modes.hpp"
#include "materials/composite_rates.hpp"
#include "materials/composite_settle.hpp"
#include "materials/composite_start.hpp"
#include "materials/composite_tangent.hpp"

namespace vitrum {
namespace {

template <bool D, Yielding Y>
std::shared_ptr<const Material> with_decohesion(const MaterialParameters& p, double cell) {
  if (p.decohesion) return std::make_shared<Composite<D, Y, true>>(p, cell);
  return std::make_shared<Composite<D, Y, false>>(p, cell);
}

template <bool D>
std::shared_ptr<const Material> with_yield(const MaterialParameters& p, double cell) {
  if (p.von_mises) return with_decohesion<D, Yielding::von_mises>(p, cell);
  if (p.drucker_prager) return with_decohesion<D, Yielding::drucker_prager>(p, cell);
  return with_decohesion<D, Yielding::none>(p, cell);
}

}  // namespace

std::shared_ptr<const Material> make_material(const MaterialParameters& p, double cell) {
  if (p.von_mises && p.drucker_prager)
    throw std::invalid_argument("material '" + p.name + "': von_mises and drucker_prager exclude each other");
  return p.damage ? with_yield<true>(p, cell) : with_yield<false>(p, cell);
}

std::string_view event_name(EventKind kind) {
  switch (kind) {
    case EventKind::damage:
      return "damage";
    case EventKind::yield:
      return "yield";
    case EventKind::peak:
      return "peak";
    case EventKind::localisation:
      return "localisation";
    case EventKind::separation:
      return "separation";
    case EventKind::closure:
      return "closure";
  }
  return "unknown";
}

}  // namespace vitrum
