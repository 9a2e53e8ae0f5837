#include "tools/kbc/drive_log.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "compiler/program/text.h"
#include "sim/report/row.h"
#include "tools/kbc/trace/facts_options.h"
#include "tools/kbc/wire/line.h"

namespace kb::cli {

using diagnostics::Kind;

std::string knowledge_comment(const std::string& facts, const std::string& knowledge) {
  std::error_code fault;
  const std::filesystem::path folder = std::filesystem::absolute(facts, fault).parent_path();
  const std::string seen = std::filesystem::relative(knowledge, folder, fault).generic_string();
  const std::string comment = "# kb: " + seen;
  trace::FactsOptions read;
  trace::read_option_comment(comment, read);
  const bool readable = read.program == seen && seen.find_first_of("\r\n") == std::string::npos;
  return !fault && !seen.empty() && readable ? comment + "\n" : std::string();
}

bool DriveLog::open(Part& part) {
  if (part.name.empty()) return true;
  part.file = std::make_unique<trace::OutputFile>();
  return session_.open_output(*part.file, part.name);
}

bool DriveLog::open(const std::string& knowledge) {
  for (Part* part : parts_) {
    if (!open(*part)) return false;
  }
  if (facts_.file == nullptr) return true;
  head_ = knowledge_comment(facts_.name, knowledge);
  {
    sim::report::Row row(head_);
    row.text("t");
    for (std::size_t fact = 0; fact < program_.facts; ++fact) row.text(program_.cells[fact].name);
  }
  facts_.file->write(head_);
  return true;
}

void DriveLog::ticked(const program::Tick& tick, std::string_view json, std::span<const float> facts) {
  if (facts_.file != nullptr) {
    std::string bytes;
    const std::string seconds = program::seconds_text(tick.time_us);   // the mind's time, which stands still while the robot waits: with it, `kbc run` ticks in the same way
    {
      sim::report::Row row(bytes);
      row.text(seconds);
      for (const float value : facts) row.certainty(value);
    }
    facts_.file->write(bytes);
  }
  if (trace_.file != nullptr) trace_.file->write(std::string(json) + "\n");
}

void DriveLog::heard(std::string_view line, std::string_view answer, bool understood) {
  if (record_.file != nullptr) record_.file->write((understood ? wire::with_answer(line, answer) : std::string(line)) + "\n");
  keep();
}

void DriveLog::keep() {
  for (Part* part : parts_) {
    if (part->file == nullptr || part->file->failed()) continue;
    part->file->keep();
    if (!part->file->flush()) report(*part);
  }
}

void DriveLog::report(const Part& part) {
  const trace::OutputFile& file = *part.file;
  std::error_code ignored;
  const bool is_there = file.stays_beside() && std::filesystem::exists(file.beside(), ignored);
  session_.report(Kind::kCannotWrite, {part.name, file.error() + (is_there ? fmt::format("; what came before is in `{}`", file.beside()) : std::string())});
  good_ = false;
}

void DriveLog::reopen() {
  for (Part* part : parts_) {
    if (part->file == nullptr || part->file->failed()) continue;
    std::string refused;
    if (part->file->reopen(refused)) part->file->write(part == &facts_ ? head_ : std::string());
    if (!refused.empty()) session_.report(Kind::kCannotWrite, {part->name, refused + "; it goes on in the file that it had"});
    if (part->file->failed()) report(*part);
  }
}

bool DriveLog::end() {
  for (Part* part : parts_) {
    if (part->file != nullptr && !part->file->failed() && !part->file->commit()) report(*part);
  }
  return good_;
}

}  // namespace kb::cli
