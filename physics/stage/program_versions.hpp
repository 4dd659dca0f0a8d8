#pragma once
#include <map>
#include <string>

namespace cupola {

/// What `PROGRAM --versions` prints: a JSON object with `cupola`, `HDF5`, `Open MPI` and the libraries handed over.
std::string versions_text(std::map<std::string, std::string> libraries);

}  // namespace cupola
