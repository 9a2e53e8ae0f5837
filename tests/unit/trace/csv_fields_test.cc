#include "tools/kbc/trace/csv_fields.h"

#include <gtest/gtest.h>

#include <vector>

namespace kb::trace {
namespace {

std::vector<std::string> fields_of(std::string_view line, bool header = false) {
  std::vector<std::string> out;
  std::string scratch;
  for (FieldCursor fields(line, scratch, header); fields.more();) out.emplace_back(fields.next().text);
  return out;
}
using Fields = std::vector<std::string>;

TEST(CsvFields, are_cut_at_commas_and_trimmed) {
  EXPECT_EQ(fields_of("a, b ,\tc"), (Fields{"a", "b", "c"}));
  EXPECT_EQ(fields_of("a,,"), (Fields{"a", "", ""}));
  EXPECT_EQ(fields_of(""), (Fields{""}));
}

TEST(CsvFields, keep_commas_and_doubled_quotes_inside_of_quotes) {
  EXPECT_EQ(fields_of(R"("a,b" ,"say ""yes""","")"), (Fields{"a,b", "say \"yes\"", ""}));
}

TEST(CsvFields, of_a_header_keep_commas_inside_of_brackets) {
  EXPECT_EQ(fields_of("Cross[right,mark],Line", true), (Fields{"Cross[right,mark]", "Line"}));
  EXPECT_EQ(fields_of("a[1,b", false), (Fields{"a[1", "b"}));
}

TEST(CsvFields, say_where_a_quote_is_wrong) {
  std::string scratch;
  FieldCursor open("1,\"2", scratch);
  open.next();
  const Field field = open.next();
  EXPECT_EQ(field.fault, Field::Fault::kOpenQuote);
  EXPECT_EQ(field.begin, 2u);
  EXPECT_FALSE(open.more());
}

}  // namespace
}  // namespace kb::trace
