#pragma once
#include <map>
#include <string>

namespace cupola {

/// What `PROGRAM --versions` prints: a JSON object with `cupola`, `hdf5`, `mpi` and the libraries handed over.
std::string program_versions(std::map<std::string, std::string> libraries);

}  // namespace cupola
