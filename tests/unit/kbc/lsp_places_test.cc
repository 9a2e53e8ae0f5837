#include "tools/kbc/lsp/places.h"

#include <gtest/gtest.h>

#include "compiler/diagnostics/place.h"

namespace {

using kb::lsp::Encoding;

constexpr std::string_view kText = "one\n\u00fc\U0001F916x\r\n\nlast";

TEST(LspPlaces, OffsetsGoToPositionsAndBack) {
  kb::source::Sources sources;
  const auto file = sources.add("a.kb", std::string(kText));
  const kb::lsp::Places places(sources);
  for (const Encoding encoding : {Encoding::kUtf8, Encoding::kUtf16}) {
    for (std::uint32_t at = 0; at <= kText.size(); ++at) {
      if (at < kText.size() && (static_cast<unsigned char>(kText[at]) & 0xC0u) == 0x80u) continue;   // within a character
      if (at < kText.size() && kText[at] == '\n' && at > 0 && kText[at - 1] == '\r') continue;       // within a line break
      const kb::lsp::Position place = places.position(file, at, encoding);
      EXPECT_EQ(kb::lsp::offset(kText, place, encoding), at);
    }
  }
}

TEST(LspPlaces, UnitsOfUtf16AndOfBytes) {
  kb::source::Sources sources;
  const std::string text = "\u00fc\U0001F916x";
  const auto file = sources.add("a.kb", text + text);
  const kb::lsp::Places places(sources);
  const kb::source::Span second{file, static_cast<std::uint32_t>(text.size()), static_cast<std::uint32_t>(2 * text.size())};
  EXPECT_EQ(places.units(second, Encoding::kUtf16), 4u);
  EXPECT_EQ(places.units(second, Encoding::kUtf8), 7u);
}

TEST(LspPlaces, AMarkOfByteOrderIsACharacterOfTheFirstLine) {
  kb::source::Sources sources;
  const auto file = sources.add("a.kb", "\xEF\xBB\xBF" "ab\ncd");
  const kb::lsp::Places places(sources);
  EXPECT_EQ(places.position(file, 0, Encoding::kUtf16).character, 0u);
  EXPECT_EQ(places.position(file, 4, Encoding::kUtf16).character, 2u);
  EXPECT_EQ(places.position(file, 7, Encoding::kUtf16).character, 1u);
}

TEST(LspPlaces, APlaceBehindTheEndIsTheEnd) {
  EXPECT_EQ(kb::lsp::offset("ab\ncd", {0, 99}, Encoding::kUtf16), 2u);
  EXPECT_EQ(kb::lsp::offset("ab\ncd", {99, 0}, Encoding::kUtf16), 5u);
  EXPECT_EQ(kb::lsp::offset("ab\r\ncd", {0, 99}, Encoding::kUtf16), 2u) << "before the line break";
  EXPECT_EQ(kb::lsp::offset("", {1, 1}, Encoding::kUtf16), 0u);
}

TEST(LspPlaces, PathsGoToUrisAndBack) {
  for (const std::string path : {"/a/b.kb", "/with blank/\u00fc%25.kb", "/#?&:+.kb"}) EXPECT_EQ(kb::lsp::path_of(kb::diagnostics::uri(path)), path);
  EXPECT_EQ(kb::diagnostics::uri("/a b"), "file:///a%20b");
  EXPECT_EQ(kb::lsp::path_of("file://localhost/a"), "/a");
  EXPECT_EQ(kb::lsp::path_of("file:///a%2"), "/a%2") << "no code";
  EXPECT_EQ(kb::lsp::path_of("file:///%zz%41"), "/%zzA");
  EXPECT_EQ(kb::lsp::path_of("untitled:a"), std::nullopt);
  EXPECT_EQ(kb::lsp::path_of("file://other/a"), std::nullopt) << "another machine";
}

}  // namespace
