#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>

#include "schemas/campaign_reader.hpp"
#include "schemas/resolved_campaign.hpp"

/// Any text as a campaign file: it is refused with at least one sentence, each with a place in the text; or it is a
/// campaign, and that campaign spelt out is read as itself.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto fail = [&](const std::string& what) {
    std::cerr << what << "\n";
    std::abort();
  };
  const auto read = cupola::read_campaign_text(text, "fuzz.yaml");
  for (const auto& error : read.errors)
    if (error.line < 1 || error.column < 1 || error.message.empty()) fail("an error without a place or a sentence");
  if (!read.ok()) return 0;
  const std::string resolved = cupola::resolved_yaml(read.campaign);
  const auto again = cupola::read_campaign_text(resolved, "resolved.yaml");
  if (!again.ok()) fail("the resolved campaign is refused:\n" + cupola::to_text(again.errors) + resolved);
  if (cupola::resolved_yaml(again.campaign) != resolved) fail("the resolved campaign is another one:\n" + resolved);
  return 0;
}
