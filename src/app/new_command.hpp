#pragma once
#include <string>

namespace vitrum::app {

struct NewOptions {
  std::string name = "impact";  // of the template; blanks and underscores stand for hyphens
  std::string out;              // file; "": standard output
  bool list = false;            // names instead, with what they are
};

/// Writes a template of a scene (examples/NAME.toml), or lists them. Raises InputError for an unknown name
/// and for a file that is there already, FileError where it cannot be written.
int new_scene(const NewOptions& options);

}  // namespace vitrum::app
