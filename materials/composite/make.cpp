#include "materials/composite/make.hpp"

#include <stdexcept>

#include "materials/composite/intact.hpp"
#include "materials/composite/jumps.hpp"
#include "materials/composite/law.hpp"
#include "materials/composite/localised.hpp"
#include "materials/composite/modes.hpp"
#include "materials/composite/rates.hpp"
#include "materials/composite/settle.hpp"
#include "materials/composite/start.hpp"

namespace vitrum {
namespace {

template <bool D, Yielding Y>
std::shared_ptr<const Material> with_decohesion(const MaterialParameters& p, double cell) {
  if (p.decohesion) return std::make_shared<Batch<Composite<D, Y, true>>>(p, Composite<D, Y, true>(p, cell));
  return std::make_shared<Batch<Composite<D, Y, false>>>(p, Composite<D, Y, false>(p, cell));
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
  return p.damage ? with_yield<true>(p, cell) : with_yield<false>(p, cell);
}

}  // namespace vitrum
