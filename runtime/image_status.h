// Why an image is refused.
#pragma once

#include <cstdint>

#include "cpp20.h"

namespace mts {

/// What was found first. Anything but kOk refuses the image as a whole.
enum class ImageStatus : std::uint8_t {
  kOk,
  // the file
  kTooShort,       ///< shorter than a head, or a null pointer
  kNotAnImage,     ///< does not begin with the mark of an image
  kOtherForm,      ///< of another version of the file's form
  kOtherAbi,       ///< made for another version of the runtime
  kByteOrder,      ///< this machine is big-endian
  kMisaligned,     ///< the bytes do not begin at a multiple of four
  kWrongSize,      ///< cut off, or something was appended, or the counts are not those of the file
  kWrongChecksum,  ///< damaged
  kOtherWidth,     ///< its indexes are not of the width that was asked for, or not of the one that it must have
  kNoScratch,      ///< fewer words of working memory than `scratch_words` says
  kNoMemory,       ///< the block for the state is null, too small, not aligned to 8, or overlaps the block in use, the image in use or the new one
  // the tables
  kSettings,       ///< firing, idle, hold limit
  kPadding,        ///< bytes between sections or within rows that are not zero
  kLevels,         ///< levels, words and rules do not partition one another
  kRules,          ///< rules' ranges; conditions
  kKeys,           ///< a rule does not sleep under exactly one of its conditions
  kReaders,        ///< who reads an atom is not who has it as a condition
  kWrites,         ///< cells or values of effects
  kContested,      ///< the number of cells that may be contested is not the one that follows from the rules
  kAtoms,          ///< what atoms are: cells' terms and facts' sightings
  kFacts,          ///< thresholds
  kAttention,      ///< which satellite draws attention to which facts
  kNodes,          ///< parts and wholes of conditions
  kTimers,         ///< timers, queues, stages
  kGroups,         ///< exclusive groups
  kPriority,       ///< does not hold every strategy once
  kInitial,        ///< the state of start-up does not follow from the tables
  kStrengths,      ///< what contradicting rules need
  kNames,          ///< not UTF-8, not in order, or twice the same
};

// As in runtime/status.h.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wswitch-default"
/// A few words for messages. Static text.
[[nodiscard]] constexpr const char* text(ImageStatus status) {
  switch (status) {
    case ImageStatus::kOk: return "ok";
    case ImageStatus::kTooShort: return "too short to be an image";
    case ImageStatus::kNotAnImage: return "not an image";
    case ImageStatus::kOtherForm: return "of another version of the file's form";
    case ImageStatus::kOtherAbi: return "made for another version of the runtime";
    case ImageStatus::kByteOrder: return "this machine is big-endian";
    case ImageStatus::kMisaligned: return "not aligned in memory";
    case ImageStatus::kWrongSize: return "cut off, or its counts are not those of the file";
    case ImageStatus::kWrongChecksum: return "damaged: the checksum differs";
    case ImageStatus::kOtherWidth: return "its indexes are of another width";
    case ImageStatus::kNoScratch: return "too little working memory to verify it";
    case ImageStatus::kNoMemory: return "the block for its state is null, too small, not aligned to 8, or overlaps the block in use or an image";
    case ImageStatus::kSettings: return "its settings are out of range";
    case ImageStatus::kPadding: return "bytes that must be zero are not";
    case ImageStatus::kLevels: return "its levels and words of rules do not fit together";
    case ImageStatus::kRules: return "its rules have wrong ranges or conditions";
    case ImageStatus::kKeys: return "its rules' keys are wrong";
    case ImageStatus::kReaders: return "its readers are not those that read";
    case ImageStatus::kWrites: return "its rules' effects are wrong";
    case ImageStatus::kContested: return "its count of contested cells is wrong";
    case ImageStatus::kAtoms: return "its atoms are not those of its cells";
    case ImageStatus::kFacts: return "a fact's thresholds are out of range";
    case ImageStatus::kAttention: return "its table of attention is wrong";
    case ImageStatus::kNodes: return "its conditions' parts are wrong";
    case ImageStatus::kTimers: return "its timers are wrong";
    case ImageStatus::kGroups: return "its exclusive groups are wrong";
    case ImageStatus::kPriority: return "its priority does not hold every strategy once";
    case ImageStatus::kInitial: return "its state of start-up does not follow from its tables";
    case ImageStatus::kStrengths: return "its tables of strength are wrong";
    case ImageStatus::kNames: return "its names are wrong";
  }
  return "unknown";
}
#pragma GCC diagnostic pop

}  // namespace mts
