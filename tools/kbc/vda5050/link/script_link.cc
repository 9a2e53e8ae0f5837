#include "tools/kbc/vda5050/link/script_link.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "compiler/program/text.h"
#include "tools/kbc/wire/fields.h"

namespace kb::vda5050 {

using diagnostics::Kind;
using wire::Field;
using wire::Json;
using wire::Mistake;
using wire::Reading;

namespace {

constexpr double kLatest_s = 1e11;   // as for lines of the robot
constexpr std::array<std::string_view, 2> kSides{"master", "vehicle"};
constexpr std::array<std::string_view, 2> kOfMaster{"order", "instantActions"};

/// A line while it is read.
struct Draft {
  const Json* topic = nullptr;     // these are null until they have been read
  const Json* message = nullptr;
  const Json* t = nullptr;
  double t_s = 0.0;
  std::string from{kSides[0]};
  std::string name;
  [[nodiscard]] std::int64_t t_us() const { return std::llround(t_s * 1e6); }
};

constexpr std::array kFields{
    Field<Draft>{"t", [](Reading& reading, const Json& json, Draft& draft) {
      reading.number("t", json, {0.0, kLatest_s}, draft.t_s);
      draft.t = &json;
    }},
    Field<Draft>{"from", [](Reading& reading, const Json& json, Draft& draft) { reading.word("from", json, kSides, draft.from); }},
    Field<Draft>{"topic", [](Reading& reading, const Json& json, Draft& draft) {
      reading.text("topic", json, draft.name);
      draft.topic = &json;
    }},
    Field<Draft>{"message", [](Reading& reading, const Json& json, Draft& draft) {
      if (json.kind != Json::Kind::kString) static_cast<void>(reading.is("message", json, Json::Kind::kObject));
      draft.message = &json;
    }},
};

void look_for_what_is_missing(Reading& reading, const Json& object, const Draft& draft) {
  if (draft.t == nullptr) reading.missing("t", "each line says when its message comes, in s of the robot's clock", object.span);
  if (draft.topic == nullptr) reading.missing("topic", "a master writes an `order` or `instantActions`", object.span);
  if (draft.message == nullptr) reading.missing("message", "what comes is an object, or a string where it is no JSON", object.span);
}

/// Reads the lines of one file; their times must not fall.
class ScriptReader {
 public:
  explicit ScriptReader(std::vector<ScriptMessage>& messages) : messages_(messages) {}

  [[nodiscard]] std::optional<Mistake> line(std::string_view text) {
    Reading reading;
    const auto object = reading.object(text);
    if (!object) return reading.mistake();
    Draft draft;
    wire::read_fields<Draft>(reading, "", *object, kFields, draft);
    look_for_what_is_missing(reading, *object, draft);
    const bool of_master = draft.from == kSides[0];
    if (of_master && draft.topic != nullptr) reading.word("topic", *draft.topic, kOfMaster, draft.name);
    if (reading.mistake()) return reading.mistake();
    if (draft.t_us() < t_us_) return Mistake{Kind::kLinkBackwards, {program::seconds_text(draft.t_us()), program::seconds_text(t_us_), {}}, "t", draft.t->span};
    t_us_ = draft.t_us();
    if (!of_master) return std::nullopt;
    const bool json = draft.message->kind == Json::Kind::kObject;
    messages_.push_back({t_us_, {draft.name, json ? std::string(wire::part_at(text, draft.message->span.begin)) : draft.message->text}});
    return std::nullopt;
  }

 private:
  std::vector<ScriptMessage>& messages_;
  std::int64_t t_us_ = 0;
};

/// Whether it is a JSON object, and so can stand in a line as it is once its line breaks are gone.
bool is_object(std::string_view payload) {
  json::Fault fault;
  const auto list = json::parse(fmt::format("[{}]", payload), source::FileId::kNone, fault);   // in a list, so that it is nested as deep as in the line
  return list && list->parts.size() == 1 && list->parts.front().kind == Json::Kind::kObject;
}

}  // namespace

std::optional<std::vector<ScriptMessage>> read_script(const std::string& path, const source::FileSystem& files, source::Sources& sources,
                                                      diagnostics::Diagnostics& diagnostics) {
  const auto file = diagnostics::open_file(path, files, sources, diagnostics);
  if (!file) return std::nullopt;
  const std::string_view bytes = sources.bytes(*file);
  std::vector<ScriptMessage> messages;
  ScriptReader reader(messages);
  bool good = true;
  for (std::size_t begin = 0; begin < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\n', begin), bytes.size());
    const std::string_view line = bytes.substr(begin, end - begin);
    if (line.find_first_not_of(" \t\r") != std::string_view::npos) {
      if (const auto mistake = reader.line(line)) {
        const auto at = static_cast<std::uint32_t>(begin);
        wire::report(*mistake, {*file, at + mistake->span.begin, at + mistake->span.end}, diagnostics);
        good = false;
      }
    }
    begin = end + 1;
  }
  return good ? std::optional(std::move(messages)) : std::nullopt;
}

std::optional<Message> ScriptLink::next(std::int64_t t_us) {
  if (given_ == messages_.size() || messages_[given_].t_us > t_us) return std::nullopt;
  return messages_[given_++].message;
}

std::string print_script_line(std::int64_t t_us, std::string_view from, const Message& message) {
  std::string out = "{\"t\":";
  program::append_seconds(out, t_us);
  for (const auto& [key, text] : {std::pair("from", from), std::pair("topic", std::string_view(message.topic))}) {
    program::append_key(out, key);
    program::append_json(out, text);
  }
  program::append_key(out, "message");
  if (is_object(message.payload)) {
    std::string line = message.payload;   // in JSON line breaks stand only between tokens, never in strings
    std::replace_if(line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    out += line;
  } else {
    out += nlohmann::json(message.payload).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }
  return out + "}\n";
}

std::optional<Message> Recorder::next(std::int64_t t_us) {
  auto message = link_->next(t_us);
  if (message) file_.write(print_script_line(t_us, kSides[0], *message));
  return message;
}

void Recorder::send(const Message& message, std::int64_t t_us) {
  link_->send(message, t_us);
  file_.write(print_script_line(t_us, kSides[1], message));
}

}  // namespace kb::vda5050
