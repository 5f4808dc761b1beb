#include <cerrno>
#include <cstdio>
#include <cstring>

#include "app/command_line.hpp"
#include "app/messages.hpp"

int main(int argc, char** argv) {
  vitrum::app::open_standard_streams();
  const int status = vitrum::app::command_line(argc, argv);
  // What was printed reaches its file only now: the disk may be full.
  if ((std::ferror(stdout) == 0 && std::fflush(stdout) == 0) || status != vitrum::app::exit_done)
    return status;
  vitrum::app::tell("error: standard output: cannot be written: {}\n", std::strerror(errno));
  return vitrum::app::exit_file;
}
