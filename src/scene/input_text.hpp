#pragma once
#include <string>
#include <string_view>

namespace vitrum {

/// A text that is read, and what messages call it.
struct InputText {
  std::string name, text;
};

/// The text that a command names; "-" stands for standard input, which messages call <stdin>. Throws
/// InputError when there is no such file, FileError when it cannot be read.
InputText read_input(const std::string& file);

/// The content of a file that another one names; messages say what it was `expected` to be. Throws as
/// read_input does.
std::string read_file(const std::string& file, std::string_view expected);

}  // namespace vitrum
