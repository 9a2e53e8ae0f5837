// Names by the thousand: each is found as it was declared first, in the order of declaration.
#include "compiler/model/names.h"

#include <gtest/gtest.h>

#include "compiler/diagnostics/consumers.h"

namespace kb::model {
namespace {

TEST(Names, AreFoundHoweverManyThereAre) {
  std::vector<std::string> texts;
  for (std::uint32_t i = 0; i < 5'000; ++i) texts.push_back("J" + std::to_string(i));
  const source::Sources sources;
  diagnostics::CountingConsumer reports;
  diagnostics::Diagnostics diagnostics(sources, reports);
  Names names;
  for (std::uint32_t i = 0; i < texts.size(); ++i) {
    if (i == 1'000) names.reserve(3'000);   // and beyond what room was made for
    ASSERT_TRUE(names.declare({{}, texts[i]}, {Entity::Kind::kLandmark, i, {}}, diagnostics));
  }
  for (std::uint32_t i = 0; i < texts.size(); ++i) {
    ASSERT_NE(names.find(texts[i]), nullptr);
    ASSERT_EQ(names.find(texts[i])->id, i);
    ASSERT_EQ(names.all()[i].text, texts[i]);
  }
  EXPECT_EQ(names.find("J5000"), nullptr);
  EXPECT_EQ(names.find(""), nullptr);
  EXPECT_EQ(reports.errors + reports.warnings, 0u);
}

TEST(Names, KeepTheFirstDeclaration) {
  const source::Sources sources;
  diagnostics::CountingConsumer reports;
  diagnostics::Diagnostics diagnostics(sources, reports);
  Names names;
  EXPECT_TRUE(names.declare({{}, "A"}, {Entity::Kind::kFact, 1, {}}, diagnostics));
  EXPECT_FALSE(names.declare({{}, "A"}, {Entity::Kind::kFact, 2, {}}, diagnostics));
  names.declare_quietly("A", {Entity::Kind::kFact, 3, {}});
  EXPECT_EQ(names.find("A")->id, 1u);
  EXPECT_EQ(names.all().size(), 1u);
  EXPECT_EQ(reports.errors + reports.warnings, 1u);
}

}  // namespace
}  // namespace kb::model
