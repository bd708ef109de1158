#pragma once

namespace spia {

/// Backtracking line search: the first that is good of a step length, its half, its quarter and so
/// on; 0 if none of `most` is. [Nocedal and Wright 2006, alg. 3.1]
/// @param good  whether a step of that length may be taken; takes it, too
template <class Good> double backtrack(double length, int most, const Good& good)
{
    for (int tried = 0; tried < most; ++tried, length *= 0.5)
        if (good(length))
            return length;
    return 0;
}

} // namespace spia
