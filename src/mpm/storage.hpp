#pragma once
#include "mpm/particles.hpp"

namespace vitrum::mpm {

/// Calls call(column) for all that particles keep from step to step, in a fixed order.
template <class AnyParticles, class Call>
void for_each_column(AnyParticles& p, Call&& call) {
  const auto all = [&](auto& columns) {
    for (auto& column : columns) call(column);
  };
  all(p.position), all(p.velocity), all(p.elastic_strain), all(p.variables), all(p.stretch), all(p.domain);
  call(p.mass), call(p.identity), call(p.turn), call(p.mirrored);
}

}  // namespace vitrum::mpm
