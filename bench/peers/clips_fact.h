// A fact of CLIPS that stands or not.
#pragma once

namespace peers {

struct ClipsFact {
  void* of_template = nullptr;
  void* fact = nullptr;   ///< null: it does not stand

  /// Asserts or retracts it, if it is not so already.
  void stand(void* environment, bool now);
};

}  // namespace peers
