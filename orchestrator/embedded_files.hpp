#pragma once
#include <string>

/// Texts that lie as files beside this header and are compiled into the program (CMakeLists.txt).
namespace cupola {

/// `starter_campaign.yaml`, what `cupola init` writes.
const std::string& starter_campaign();

/// `smoke_campaign.yaml`, what `cupola doctor` runs.
const std::string& smoke_campaign();

}  // namespace cupola
