#include "materials/composite/make.hpp"

#include <stdexcept>

#include "materials/composite/acting_models.hpp"
#include "materials/composite/damage_at_once.hpp"
#include "materials/composite/elastic_runs.hpp"
#include "materials/composite/flow_behind_crack.hpp"
#include "materials/composite/intact.hpp"
#include "materials/composite/jumps.hpp"
#include "materials/composite/localisation_search.hpp"
#include "materials/composite/localised.hpp"
#include "materials/composite/plane.hpp"
#include "materials/composite/projection.hpp"
#include "materials/composite/rates.hpp"
#include "materials/composite/rubble.hpp"
#include "materials/composite/start.hpp"
#include "materials/composite/transitions.hpp"
#include "materials/composite/yield_surface.hpp"

namespace vitrum {
namespace {

template <bool D, Yielding Y>
std::shared_ptr<const Material> with_decohesion(const MaterialParameters& p, double cell) {
  if (p.decohesion)
    return std::make_shared<Batch<CompositeClosedForm<D, Y, true>>>(p,
                                                                    CompositeClosedForm<D, Y, true>(p, cell));
  return std::make_shared<Batch<CompositeClosedForm<D, Y, false>>>(p,
                                                                   CompositeClosedForm<D, Y, false>(p, cell));
}

template <bool D>
std::shared_ptr<const Material> with_yield(const MaterialParameters& p, double cell) {
  if (p.von_mises) return with_decohesion<D, Yielding::von_mises>(p, cell);
  if (p.drucker_prager) return with_decohesion<D, Yielding::drucker_prager>(p, cell);
  return with_decohesion<D, Yielding::none>(p, cell);
}

}  // namespace

std::shared_ptr<const Material> make_composite(const MaterialParameters& p, double cell) {
  if (p.von_mises && p.drucker_prager)
    throw std::invalid_argument("material '" + p.name + "': von_mises and drucker_prager exclude each other");
  if (p.decohesion && p.decohesion->separated == Separated::drucker_prager &&
      !(p.drucker_prager && p.drucker_prager->beta > 0.0))
    throw std::invalid_argument("material '" + p.name + "': rubble needs drucker_prager with beta > 0");
  return p.damage ? with_yield<true>(p, cell) : with_yield<false>(p, cell);
}

}  // namespace vitrum
