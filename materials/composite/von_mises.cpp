#include "materials/composite/von_mises.hpp"

namespace vitrum {

PlasticReturn VonMisesLaw::flow(double trial, double shear, double& plastic_strain) const {
  PlasticReturn result;
  double stress = trial;  // |s| of the trial minus what has flowed so far
  double carried =
      radius(plastic_strain);  // |s| that the material bears; above the strength while a snap-back falls
  // Hardening, softening and floor branches, each with its own linear consistency condition.
  for (int branch = 0; branch < 3; ++branch) {
    const double start_radius = radius(plastic_strain);
    const double excess = stress - start_radius;
    if (excess <= 0.0) break;
    const double slope = 2.0 * shear + factor * modulus(plastic_strain);
    const double branch_end = plastic_strain < peak_strain_    ? peak_strain_
                              : plastic_strain < floor_strain_ ? floor_strain_
                                                               : std::numeric_limits<double>::infinity();
    // slope <= 0: the stress falls faster than elasticity can follow, so the branch is passed at once.
    const double wanted = slope > 0.0 ? excess / slope : std::numeric_limits<double>::infinity();
    const double step = std::min(wanted, branch_end - plastic_strain);
    const bool ends_branch = step < wanted;
    const double end = ends_branch ? branch_end : plastic_strain + step;
    const double end_radius = start_radius + factor * modulus(plastic_strain) * step;
    // A snap-back falls along the elastic line, at constant strain, until it meets the strength again.
    const double falling = slope > 0.0 ? std::min(step, (carried - start_radius) / slope) : step;
    const double landed = carried - 2.0 * shear * falling;
    result.dissipation += 0.5 * (carried + landed) * falling + 0.5 * (landed + end_radius) * (step - falling);
    carried = falling < step ? end_radius : landed;
    result.flow += step;
    stress -= 2.0 * shear * step;
    plastic_strain = end;
    if (!ends_branch) break;
  }
  return result;
}

double VonMisesLaw::work(double from, double to) const {
  // Linear on each branch: the mean of its ends.
  double sum = 0.0;
  const auto add = [&](double begin, double end) {
    begin = std::max(begin, from), end = std::min(end, to);
    if (end > begin) sum += (end - begin) * radius(0.5 * (begin + end));
  };
  add(0.0, peak_strain_), add(peak_strain_, floor_strain_);
  add(floor_strain_, std::numeric_limits<double>::infinity());
  return sum;
}

CriticalPlane von_mises_critical_plane(const SymmetricTensor& s, const Moduli& moduli, double tangent_drop,
                                       bool all) {
  const double G = moduli.shear, M = moduli.p_wave();
  const double squared_norm = contract(s, s);
  if (!(squared_norm > 0.0)) return {0.0, 0.0, 0.0};
  const InPlanePrincipal p = in_plane_principal(s);
  const double centre = 0.5 * (p.major + p.minor), radius = 0.5 * (p.major - p.minor);

  // |s.n|^2 in the metric of the elastic acoustic tensor: tau^2/G + s_n^2/M, maximal at cos 2theta (eq. 26);
  // outside [-1, 1] the extreme is the axis with the larger |s_n|.
  double cosine = radius > 0.0 ? centre * G / (radius * (M - G)) : (centre >= 0.0 ? 1.0 : -1.0);
  cosine = std::clamp(cosine, -1.0, 1.0);
  const double normal_stress = centre + radius * cosine;
  const double quotient = radius * radius * (1.0 - cosine * cosine) / G + normal_stress * normal_stress / M;
  const double c = std::sqrt(0.5 * (1.0 + cosine)), d = std::sqrt(0.5 * (1.0 - cosine));
  // n = cos(theta) e1 +- sin(theta) e3, e3 = e1 turned by +90 degrees. Of the two conjugate planes the one
  // that faces z more is taken: a rule that mirror images of a state share. (Where both face z alike, the
  // sign is +.)
  const double plus_r = c * p.direction_r - d * p.direction_z, plus_z = c * p.direction_z + d * p.direction_r;
  const double minus_r = c * p.direction_r + d * p.direction_z,
               minus_z = c * p.direction_z - d * p.direction_r;
  const bool minus = std::abs(minus_z) > std::abs(plus_z);
  CriticalPlane plane{tangent_drop / squared_norm * quotient, minus ? minus_r : plus_r,
                      minus ? minus_z : plus_z};
  if (all) {
    const double hoop = tangent_drop / squared_norm * s.tt * s.tt / M;
    if (hoop > plane.severity) plane = {hoop, 0.0, 0.0};
  }
  return plane;
}

}  // namespace vitrum
