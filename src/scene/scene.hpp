#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "integrators/grid/definition.hpp"
#include "integrators/local/definition.hpp"
#include "materials/law.hpp"
#include "mpm/shape_kind.hpp"
#include "schema/value.hpp"

namespace vitrum {

/// A vector (r, z) or (x, y).
using Vector2 = std::array<double, 2>;

enum class Geometry { axisymmetric, plane_strain };
enum class Gradients { nodes, centroids };
enum class Filter { none, pressures };
enum class ContactMethod { single, bodies };

struct Box {
  Vector2 min, max;
};
struct Disk {
  Vector2 centre;
  double radius;
};
struct Ring {
  Vector2 centre;
  double inner, outer;
};
struct Polygon {
  std::vector<Vector2> vertices;
};
/// Grey levels of a picture, 0 (black) to 255, by row from the top.
struct Greys {
  std::int64_t columns = 0, rows = 0;
  std::vector<unsigned char> levels;
};
/// The pixels of a picture whose grey level lies in an interval, as squares.
struct Image {
  std::string file;
  std::optional<std::string> sha256;  ///< of the file
  Vector2 corner{};                   ///< lower left one of the picture
  double width = 0.0;                 ///< of the picture, m
  std::array<double, 2> grey{};       ///< lowest and highest level, both included
  std::shared_ptr<const Greys> greys;

  std::int64_t columns() const { return greys->columns; }
  std::int64_t rows() const { return greys->rows; }
  double pixel() const { return width / static_cast<double>(columns()); }  ///< side, m
  /// Whether a pixel is the body's, by column and by row from below; beyond the picture none is.
  bool holds(std::int64_t column, std::int64_t row) const {
    if (column < 0 || row < 0 || column >= columns() || row >= rows()) return false;
    const double level = greys->levels[static_cast<std::size_t>((rows() - 1 - row) * columns() + column)];
    return level >= grey[0] && level <= grey[1];
  }
};
struct Region;
/// What lies in one or more of its parts.
struct Union {
  std::vector<Region> parts;
};
using Shape = std::variant<Box, Disk, Ring, Polygon, Image, Union>;

/// A shape and what is cut out of it.
struct Region {
  Region() = default;
  template <class S>
  requires(!std::is_base_of_v<Region, std::remove_cvref_t<S>> && std::is_constructible_v<Shape, S>)
      Region(S&& given)
      : shape(std::forward<S>(given)) {}  // a shape is a region

  Shape shape;
  std::vector<Region> holes;
};

/// Random displacements of a body's particles from where they are seeded, for ensembles.
struct Perturbation {
  double amplitude = 0.0;  ///< cells; each component is uniform in (-amplitude, amplitude)
  int seed = 1;
};

struct BodyDefinition : Region {
  std::string name;
  std::string material;
  int particles_per_cell = 1;                  ///< 1, 4, 9 or 16
  Vector2 velocity{0.0, 0.0};                  ///< m/s at the origin
  std::array<Vector2, 2> velocity_gradient{};  ///< rows: dv_r/d(r,z), dv_z/d(r,z), 1/s
  std::array<double, 4> stress{};              ///< (rr, zz, tt, rz), Pa
  bool relax = false;                          ///< equilibrium is found before the start
  std::optional<Perturbation> perturbation;
};

struct BoundaryDefinition {
  std::string name;
  Box box{};  ///< acts on grid nodes inside, at the start; may be infinite
  std::array<bool, 2> fixed{false, false};
  Vector2 velocity{0.0, 0.0};  ///< m/s, of the fixed components
  bool moves = true;           ///< the box, with this velocity
  int priority = 0;            ///< of boundaries that hold the same nodes, the largest acts
};

/// A charge of TNT on hard ground, whose pulse meets a surface head-on (blast.hpp).
struct BlastDefinition {
  double charge = 0.0;    ///< kg
  double standoff = 0.0;  ///< m
  std::optional<double>
      arrival;  ///< s, of the front at the surface; none: as the fits say, ignition being at 0
};

/// A pulse p (1 - s) exp(-decay s), s = (t - arrival) / duration in [0, 1].
struct FriedlanderDefinition {
  double pressure = 0.0;  ///< Pa
  double duration = 0.0;  ///< s
  double decay = 0.0;
  double arrival = 0.0;  ///< s
};

/// A part of a body's surface by its outward normal, which is the nearest to that of this side of a box, or
/// by whether it bounds a hole.
enum class Side { top, bottom, left, right, inner, outer };

/// A load on the part of a body's surface that lies in a box at the start, or on a side: a pressure, a vector
/// or a pulse.
struct TractionDefinition {
  std::string body;
  std::optional<Box> box;          ///< may be infinite
  std::optional<Side> side;        ///< instead
  std::optional<double> pressure;  ///< Pa
  std::optional<Vector2> vector;   ///< Pa
  std::optional<BlastDefinition> blast;
  std::optional<FriedlanderDefinition> friedlander;
  bool follows = false;  ///< pressure stays normal to the surface
};

/// Where a probe looks: at the particle nearest to a point, those nearest to evenly spaced points of a line,
/// or at all particles of a box, as they stand at the start.
struct ProbeLine {
  Vector2 from{}, to{};  ///< m, both ends are points
  int count = 2;
};
struct ProbeDefinition {
  std::string name, body;
  std::variant<Vector2, ProbeLine, Box> place;

  /// Of a point or a line.
  std::vector<Vector2> points() const;
};

struct OutputDefinition {
  std::optional<double> every;                     ///< s; none: only the last state
  std::optional<std::vector<std::string>> fields;  ///< none: all that the scene's models have
  std::optional<double> checkpoint_every;          ///< s; none: only on a signal
  std::optional<double> history_every;             ///< s; none: at every output
  std::optional<std::vector<std::string>> events;  ///< kinds told in events.csv; none: all
};

/// What two bodies have of their own.
struct ContactPair {
  std::array<std::string, 2> bodies;
  double friction = 0.0;
};

struct ContactDefinition {
  bool stated = false;  ///< the scene has a table [contact]
  ContactMethod method = ContactMethod::single;
  double friction = 0.0;        ///< may be infinite
  double stiffness = 1.0;       ///< of the two materials over a cell
  std::optional<double> depth;  ///< cells; none: from the speeds at which bodies meet
  bool self = false;            ///< fragments of one body touch, too
  std::vector<ContactPair> pairs;
};

/// A validated scene. Everything is SI; every default is filled in.
struct Scene {
  std::string title;
  schema::NamedNumbers parameters;                    ///< of formulas
  std::optional<std::vector<std::string>> evaluated;  ///< "NAME = VALUE", of formulas that are numbers
  Geometry geometry = Geometry::axisymmetric;
  double cell = 0.0;  ///< m
  mpm::ShapeKind shape_functions = mpm::ShapeKind::gimp;
  Gradients gradients = Gradients::nodes;
  Filter filter = Filter::none;
  double flip = 1.0;              ///< share of FLIP in the transfer of velocities; 0: PIC
  double start = 0.0, end = 0.0;  ///< s
  IntegratorDefinition integrator;
  ConstitutiveDefinition constitutive;
  OutputDefinition output;
  std::vector<BodyDefinition> bodies;
  std::vector<BoundaryDefinition> boundaries;
  ContactDefinition contact;
  std::vector<ProbeDefinition> probes;
  std::vector<TractionDefinition> tractions;
  Vector2 gravity{0.0, 0.0};                  ///< m/s^2
  std::vector<MaterialParameters> materials;  ///< in the order of the file
  std::string verbatim;                       ///< the file's text, unchanged
  std::vector<std::string> overrides;         ///< the --set arguments, in order
  schema::PlacedTexts formulas;               ///< and names of files that keys had in place of numbers
  schema::Functions functions;                ///< where they stand, the number itself is 0
  std::vector<std::string> warnings;          ///< what reading found implausible, in the order of the file
  /// Where each key stands, by dotted path: "FILE:LINE:COLUMN" or "--set N".
  std::map<std::string, std::string> places;

  /// How a message about a key begins, `FILE:LINE:COLUMN: key 'a.b'`: where it stands, or the table that
  /// lacks it.
  std::string at(const std::string& key) const;
  /// The function in place of the number at a dotted path; null: there is none.
  const schema::Function* function(const std::string& path) const;
  /// Whether there is one at or below a dotted path.
  bool varies(const std::string& path) const;
  const MaterialParameters& material_of(std::size_t body) const;
};

/// [state] of a point file. Which variables there are is a matter of the material.
struct StateDefinition {
  SymmetricTensor elastic_strain{};
  std::map<std::string, double, std::less<>>
      variables;  ///< those that are given, by the name of their column
};

/// A validated point file (`vitrum point`).
struct PointScene {
  schema::NamedNumbers parameters;                    ///< of formulas
  std::optional<std::vector<std::string>> evaluated;  ///< as a scene's
  schema::PlacedTexts formulas;                       ///< as a scene's
  MaterialParameters material;
  ConstitutiveDefinition constitutive;
  std::optional<StateDefinition> given;  ///< by [state]; `state` follows from it
  PointState state;                      ///< at the start; virgin unless the file gives [state]
  std::vector<double> time;              ///< s, increasing
  std::vector<SymmetricTensor> strain;   ///< one per time
  double size = 0.0;                     ///< cell size, m
  int samples = 200;                     ///< rows per segment
  std::vector<std::string> warnings;     ///< as a scene's
};

}  // namespace vitrum
