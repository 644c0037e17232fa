// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>

namespace moreau::detail {

/// Jumps of sweeps whose impulses move along a line, by the same amount in each sweep: load moves from one contact to another until
/// one of them slips, sticks or opens. The change per sweep is constant meanwhile, which can take 1e5 sweeps. Nesterov's
/// momentum shortens them by a factor of about 10, and Anderson's mixing can lead back to where the line began, because
/// all changes that it combines are equal.
///
/// After four stopping tests with one change, the impulses are moved on along the line by the way of the last interval, and by a
/// multiple of it as long as the change stays as it was. If a jump makes the change larger, it went too far, and is undone.
class LineJumps {
 public:
  /// What is to be done after a stopping test.
  enum class Next {
    nothing,
    mark,  ///< the line goes through these impulses
    jump,  ///< save the impulses, then move them on by factor() times the way from the mark
    undo,  ///< go back to the saved impulses
  };
  /// @param change of the plain sweep of the stopping test
  /// @param mixing whether impulses are being mixed: they are then on no line
  Next after(double change, bool mixing) {
    if (jumped_) {
      jumped_ = false;
      if (!(change <= larger * last_)) {
        last_ = 0;
        equal_ = 0;
        factor_ /= 4;
        if (factor_ < 1) {
          factor_ = 1;
          pause_ = pause_after_failure;
        }
        return Next::undo;
      }
      factor_ *= 2;
    }
    equal_ = std::abs(change - last_) <= equality * last_ ? equal_ + 1 : 0;
    last_ = change;
    if (pause_ > 0) --pause_;
    if (equal_ < 3 || pause_ > 0 || mixing) return equal_ < 2 ? Next::nothing : Next::mark;
    jumped_ = true;
    return Next::jump;
  }
  double factor() const { return factor_; }  ///< [-]
  /// There was no jump: bodies still approach each other. Impulses without a solution move along a line that has no end.
  void refuse() { jumped_ = false; }
  /// There are no more jumps: the impulses have moved by as much as they are.
  void end() {
    jumped_ = false;
    pause_ = std::numeric_limits<int>::max();
  }

 private:
  static constexpr double equality = 0.01, larger = 1.05;  // of changes, relative
  static constexpr int pause_after_failure = 8;            // stopping tests

  double last_ = 0, factor_ = 1;
  int equal_ = 0, pause_ = 0;
  bool jumped_ = false;
};

}  // namespace moreau::detail
