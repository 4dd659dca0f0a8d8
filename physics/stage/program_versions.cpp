#include "physics/stage/program_versions.hpp"

#include <H5public.h>
#include <fmt/format.h>
#include <mpi.h>

#include <array>
#include <nlohmann/json.hpp>

#include "schemas/version.hpp"

namespace cupola {

std::string versions_text(std::map<std::string, std::string> libraries) {
  unsigned major = 0;
  unsigned minor = 0;
  unsigned release = 0;
  H5get_libversion(&major, &minor, &release);
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> mpi{};
  int length = 0;
  MPI_Get_library_version(mpi.data(), &length);
  const std::string mpi_text(mpi.data(), static_cast<std::size_t>(length));
  libraries["cupola"] = program_version;
  libraries["HDF5"] = fmt::format("{}.{}.{}", major, minor, release);
  libraries["Open MPI"] = mpi_text.substr(0, mpi_text.find(','));
  return nlohmann::json(libraries).dump();
}

}  // namespace cupola
