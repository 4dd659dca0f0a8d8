#pragma once
#include <nlohmann/json.hpp>

namespace cupola {

/// Versions of this program, its compiler and the libraries it and its stages were built with: name -> version.
nlohmann::json program_versions();

}  // namespace cupola
