#include "physics/stage/process_start.hpp"

#include <unistd.h>

#include <ctime>
#include <fstream>
#include <sstream>
#include <string>

namespace cupola {

std::chrono::steady_clock::time_point process_start() {
  const auto now = std::chrono::steady_clock::now();
  std::ifstream file("/proc/self/stat");
  std::string text;
  std::getline(file, text);
  // proc(5): the name stands in brackets and may hold anything; the start is the 22nd word, the 20th behind it.
  const std::size_t name_ends = text.rfind(')');
  if (name_ends == std::string::npos) return now;
  std::istringstream words(text.substr(name_ends + 1));
  std::string word;
  for (int i = 0; i < 20; ++i) words >> word;
  timespec since_boot{};
  if (!words || clock_gettime(CLOCK_BOOTTIME, &since_boot) != 0) return now;
  const double ticks = std::stod(word) / static_cast<double>(sysconf(_SC_CLK_TCK));
  const double age = static_cast<double>(since_boot.tv_sec) + 1e-9 * static_cast<double>(since_boot.tv_nsec) - ticks;
  return now - std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                   std::chrono::duration<double>(age > 0 ? age : 0));
}

}  // namespace cupola
