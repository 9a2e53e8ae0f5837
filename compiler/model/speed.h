// How slow a road may be made.
#pragma once

namespace kb::model {

/// m/s. A robot on wheels does not drive more slowly: what asks for less is a slip of the pen, or means that nobody may drive there.
inline constexpr double kSlowest_m_per_s = 0.02;

}  // namespace kb::model
