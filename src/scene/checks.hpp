#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.hpp"
#include "scene/table_view.hpp"

/// What rows cannot say: how keys of a document that has been read must go together. Each check reports its
/// faults to the diagnostics, and looks at nothing that has been reported before.
namespace vitrum::scene {

/// "NAME = VALUE" of the parameters whose formulas are numbers now: those that the document says, and those
/// of its own. Reports parameters that have another value than the numbers were made with, and what --set
/// gives to one that no formula asks for.
std::optional<std::vector<std::string>> check_parameters(
    const TableView& document, const schema::NamedNumbers& parameters,
    const std::optional<std::vector<std::string>>& evaluated);

void check_methods(const TableView& document, const Scene& scene);
void check_materials(const TableView& document, const std::vector<MaterialParameters>& materials);
/// Reads the pictures of the scene's shapes.
void read_images(const TableView& document, Scene& scene);
void check_bodies(const TableView& document, const Scene& scene);
/// Names boundaries that have no name, too.
void check_boundaries(const TableView& document, Scene& scene);
void check_contact(const TableView& document, const Scene& scene);
void check_tractions(const TableView& document, const Scene& scene);
void check_probes(const TableView& document, const Scene& scene);
void check_state(const TableView& document, const PointScene& point);
/// The state that a point starts from. Of a file without faults.
PointState start_of(const PointScene& point);
void check_path(const TableView& document, const PointScene& point);

/// Reports a name that is empty or not a single line.
void check_name(const TableView& table, std::string_view name);

}  // namespace vitrum::scene
