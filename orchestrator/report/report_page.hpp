#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace cupola {

/// The report as one HTML text: charts, style and script stand in the program, the data goes into the page.
std::string report_page(const nlohmann::json& report);

}  // namespace cupola
