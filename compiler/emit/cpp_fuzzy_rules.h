// Inside the C++ emitter: the rules of one scope of straight code.
#pragma once

#include <string>
#include <vector>

namespace kb::emit {

/// A rule of straight code, as text.
struct StraightRule {
  std::vector<std::string> factors;      ///< of its condition, joined from left to right
  std::string weight;                    ///< " * 0.5f", or nothing
  std::string comment;
  std::string number;                    ///< in the list of rules; nothing if no output is read from it
  std::vector<std::string> statements;   ///< over the strength `s`
};

/// How factors are joined: by the block's `and`.
struct Joint {
  bool product = false;
  [[nodiscard]] std::string both(const std::string& a, const std::string& b) const;
};

/// Writes rules; each is as strong as `given` (empty at the top) and its condition joined. A beginning that several conditions
/// share is computed once; if it is 0, the code skips those rules.
void emit_rules(std::vector<StraightRule> rules, const std::string& given, Joint joint, std::size_t depth, std::string& out);

}  // namespace kb::emit
