#pragma once
#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace vitrum::app {

/// What is wrong with arguments that could not be parsed: the first command or option that is none, with the
/// one that was meant, or else `cause`, the parser's words.
std::string usage_fault(const CLI::App& program, std::string_view cause);

/// Examples for the help of a command; of the whole program for "".
std::string examples_of(std::string_view command);

}  // namespace vitrum::app
