#pragma once
#include <vector>

#include "engine/nurbs/curve_ends.h"

namespace spia {

/// Borders of spans that are halved again and again: dyadic from 0 to 1, so that they are exact
/// under t -> 1 - t and those of two sides can be united.

/// The fewest spans with which a curve can have these ends.
std::vector<double> first_borders(CurveEnds ends);

/// Whether a span is wide enough and holds enough data to be halved.
/// @param lines  the only parameters at which there are data; empty: any
bool may_halve(double from, double to, const std::vector<double>& lines);

/// The borders after halving the chosen spans. @param halve  per span
std::vector<double> halved(const std::vector<double>& borders, const std::vector<char>& halve);

std::vector<double> united(const std::vector<double>& a, const std::vector<double>& b);

/// Parameters of the data for a least squares fit over these spans: evenly in each span, borders
/// included.
/// @param lines  the only parameters at which there are data: these are taken; empty: any
std::vector<double> data_parameters(const std::vector<double>& borders, const std::vector<double>& lines);

/// The span that holds t: the last one for the end.
int span_of(const std::vector<double>& borders, double t);

} // namespace spia
