#include "mpm/filter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mpm/cell_average.hpp"
#include "mpm/point.hpp"
#include "mpm/stress.hpp"

namespace vitrum::mpm {
namespace {

/// S is applied so often: what ten cells share loses a thousandth of its amplitude, what differs within a
/// cell all of it.
constexpr int sharpness = 4;
constexpr double cells_between = 10.0;

double interval(const System& system) {
  double fastest = 0.0;
  for (const Body& body : system.bodies) fastest = std::max(fastest, body.material->wave_speed());
  return cells_between * system.cell / fastest;
}

double trace_of(const Particles& p, std::size_t i) {
  return p.elastic_strain[0][i] + p.elastic_strain[1][i] + p.elastic_strain[2][i];
}

/// Energy removed, J (per radian or per metre).
double filter(parallel::ThreadTeam& team, Body& body, double cell) {
  Particles& p = body.particles;
  const std::vector<double>& cracked = body.column("effective_length");
  const bool tension_damages = body.material->parameters().damage.has_value();
  std::vector<double> traces(p.size);
  std::vector<char> counted(p.size, 1);
  for (std::size_t i = 0; i < p.size; ++i) {
    traces[i] = trace_of(p, i);
    if ((!cracked.empty() && cracked[i] > 0.0) || (tension_damages && !(traces[i] < 0.0))) counted[i] = 0;
  }
  const CellAverage average(team, body, cell, counted);
  const std::vector<double> unseen = average.differences(traces, sharpness);
  const double specific_volume = 1.0 / body.material->density();
  return average.sum([&](std::size_t i) {
    if (unseen[i] == 0.0 || (tension_damages && !(traces[i] - unseen[i] < 0.0))) return 0.0;
    PointState s = point_of(body, i);
    const double before = body.material->stored_energy(s);
    s.elastic_strain -= (unseen[i] / 3.0) * identity();
    put_point(s, body, i);
    return p.mass[i] * specific_volume * (before - body.material->stored_energy(s));
  });
}

std::vector<double> pressures(const Body& body) {
  const TensorColumns stress = stress_of(body);
  std::vector<double> pressure(body.particles.size);
  for (std::size_t i = 0; i < pressure.size(); ++i)
    pressure[i] = -(stress[0][i] + stress[1][i] + stress[2][i]) / 3.0;
  return pressure;
}

}  // namespace

bool filter_pressures(System& system, double from, double to) {
  if (!system.filters) return false;
  const double every = interval(system);
  if (std::floor(from / every) == std::floor(to / every)) return false;
  double removed = 0.0;
  for (Body& body : system.bodies)
    if (!body.coasting) removed += filter(*system.team, body, system.cell);
  system.record.filtered += removed;
  system.record.elastic -= removed;
  return true;
}

double ringing_energy(const System& system) {
  double sum = 0.0;
  for (const Body& body : system.bodies) {
    const Particles& p = body.particles;
    std::vector<double> pressure = pressures(body);
    std::vector<char> counted(p.size, 1);
    std::fill(counted.begin() + static_cast<std::ptrdiff_t>(body.present()), counted.end(), 0);
    const CellAverage average(*system.team, body, system.cell, counted);
    const std::vector<double> own = average.differences(std::move(pressure), 1);
    const double bulk = elastic_moduli(body.material->parameters().elastic).bulk,
                 specific_volume = 1.0 / body.material->density();
    sum += average.sum(
        [&](std::size_t i) { return p.mass[i] * specific_volume * own[i] * own[i] / (2.0 * bulk); });
  }
  return sum;
}

}  // namespace vitrum::mpm
