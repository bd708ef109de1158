#pragma once

namespace spia {

/// How far a surface may be from the part where no tolerance was asked for, mm: what CAD of sheet
/// parts is usually held to. An interpolating surface is judged by it, too
/// (DeviationStatistics::within).
inline constexpr double usual_tolerance = 0.1;

} // namespace spia
