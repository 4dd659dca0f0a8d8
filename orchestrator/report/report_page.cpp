#include "orchestrator/report/report_page.hpp"

#include <string_view>

#include "schemas/failure.hpp"

// The page as bundled at build time, byte for byte.
__asm__(
    ".pushsection .rodata\n"
    ".global cupola_report_page_begin\n"
    ".global cupola_report_page_end\n"
    "cupola_report_page_begin:\n"
    ".incbin \"" CUPOLA_REPORT_PAGE
    "\"\n"
    "cupola_report_page_end:\n"
    ".byte 0\n"
    ".popsection\n");

extern "C" {
extern const char cupola_report_page_begin[];  // NOLINT(modernize-avoid-c-arrays): defined by the assembler above
extern const char cupola_report_page_end[];    // NOLINT(modernize-avoid-c-arrays)
}

namespace cupola {

namespace {

constexpr std::string_view data_marker = "/*DATA*/";

/// JSON that may stand in a script element: nothing in it can end the element or begin a comment.
std::string embedded(const nlohmann::json& value) {
  const std::string text = value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char character : text) {
    if (character == '<') {
      safe += "\\u003c";
    } else {
      safe += character;
    }
  }
  return safe;
}

}  // namespace

std::string report_page(const nlohmann::json& report) {
  const std::string_view page(cupola_report_page_begin,
                              static_cast<std::size_t>(cupola_report_page_end - cupola_report_page_begin));
  const std::size_t place = page.find(data_marker);
  if (place == std::string_view::npos) {
    throw Failure(ExitCode::input_output,
                  "the report's page in this program holds no place for the data: build it again");
  }
  std::string text(page.substr(0, place));
  text += embedded(report);
  text += page.substr(place + data_marker.size());
  return text;
}

}  // namespace cupola
