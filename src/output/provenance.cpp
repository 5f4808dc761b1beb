#include "output/provenance.hpp"

#include <fmt/format.h>
#include <klu.h>
#include <sundials/sundials_version.h>
#include <toml++/toml.h>
#include <unistd.h>

#include <Eigen/Core>
#include <ctime>
#include <utility>

#include "output/hdf5.hpp"
#include "vitrum_version.hpp"

namespace vitrum::output {
namespace {

std::string sundials_version() {
  std::array<char, 64> text{};
  SUNDIALSGetVersion(text.data(), static_cast<int>(text.size()));
  return text.data();
}

}  // namespace

std::string host_name() {
  std::array<char, 256> text{};
  if (gethostname(text.data(), text.size() - 1) != 0) return "unknown";
  return text.data();
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm broken_down{};
  gmtime_r(&now, &broken_down);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &broken_down);
  return text.data();
}

Provenance make_provenance(std::string command, std::string scene_sha256) {
  return {VITRUM_VERSION,  VITRUM_GIT,  std::move(command), sundials_version(),
          VITRUM_COMPILER, host_name(), utc_now(),          std::move(scene_sha256)};
}

std::string version_text() {
  std::array<int, 3> suitesparse{};
  SuiteSparse_version(suitesparse.data());
  std::string text = fmt::format("vitrum {} ({})\n", VITRUM_VERSION, VITRUM_GIT);
  text += fmt::format("compiler     {}\n", VITRUM_COMPILER);
  text += fmt::format("SUNDIALS     {}\n", sundials_version());
  text += fmt::format("SuiteSparse  {}.{}.{} (KLU {}.{}.{})\n", suitesparse[0], suitesparse[1],
                      suitesparse[2], KLU_MAIN_VERSION, KLU_SUB_VERSION, KLU_SUBSUB_VERSION);
  text +=
      fmt::format("Eigen        {}.{}.{}\n", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);
  text += fmt::format("HDF5         {}\n", hdf5_version());
  text += fmt::format("toml++       {}.{}.{}\n", TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH);
  text +=
      fmt::format("fmt          {}.{}.{}\n", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100);
  return text;
}

}  // namespace vitrum::output
