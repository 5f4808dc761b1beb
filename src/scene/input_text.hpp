#pragma once
#include <string>

namespace vitrum {

/// A text that is read, and what messages call it.
struct InputText {
  std::string name, text;
};

/// A file's text; "-" stands for standard input, which messages call <stdin>. Throws InputError when there is
/// no such file, FileError when it cannot be read.
InputText read_input(const std::string& file);

}  // namespace vitrum
