#include "tools/kbc/layout/json.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

namespace kb::layout {

using diagnostics::Kind;
using json::kind_name;

namespace {

constexpr double kLargestCount = 4'294'967'295.0;   // the largest uint32, the type of counts in VDA 5050

}  // namespace

std::optional<Json> read_json(const source::Sources& sources, source::FileId file, diagnostics::Diagnostics& diagnostics) {
  json::Fault fault;
  auto json = json::parse(sources.bytes(file), file, fault);
  if (json) {
    const auto twice = json::repeated_key(*json);   // a layout that says something twice is not to lose half of it silently
    if (!twice) return json;
    fault = {twice->span, fmt::format("the key `{}` is there twice", twice->key)};
  }
  diagnostics.report(Kind::kLayoutSyntax, fault.span, {"JSON", fault.what});
  return std::nullopt;
}

const Json* Fields::want(std::string_view key, Json::Kind kind) const {
  const Json* part = object_.find(key);
  if (part == nullptr) diagnostics_.report(Kind::kLayoutMissing, object_.span, {what_, key});
  return checked(part, key, kind);
}

const Json* Fields::may(std::string_view key, Json::Kind kind) const { return checked(object_.find(key), key, kind); }

const Json* Fields::checked(const Json* part, std::string_view key, Json::Kind kind) const {
  if (part == nullptr || part->kind == kind) return part;
  diagnostics_.report(Kind::kLayoutWrongKind, part->span, {key, what_, kind_name(kind), kind_name(part->kind)});
  return nullptr;
}

double Fields::number(std::string_view key) const {
  const Json* part = want(key, Json::Kind::kNumber);
  return part == nullptr ? 0.0 : part->number;
}

double Fields::count(std::string_view key) const {
  const Json* part = want(key, Json::Kind::kNumber);
  if (part == nullptr) return 0.0;
  if (!(part->number >= 0.0 && part->number <= kLargestCount) || part->number != std::floor(part->number)) {
    diagnostics_.report(Kind::kLayoutWrongKind, part->span, {key, what_, "an integer from 0 to 4,294,967,295", part->text});
  }
  return part->number;
}

std::vector<const Json*> Fields::objects(std::string_view key) const {
  std::vector<const Json*> all;
  const Json* list = want(key, Json::Kind::kList);
  if (list == nullptr) return all;
  for (const Json& part : list->parts) {
    if (part.kind == Json::Kind::kObject) all.push_back(&part);
    else diagnostics_.report(Kind::kLayoutWrongKind, part.span, {key, what_, "a list of objects", kind_name(part.kind)});
  }
  return all;
}

}  // namespace kb::layout
