#include "engine/core/place_text.h"

#include <gtest/gtest.h>
#include <vector>

namespace spia {
namespace {

TEST(PlaceText, HasSixDigitsAndNothingOfWhatRoundingLeavesOfZero)
{
    EXPECT_EQ(place_text(Eigen::Vector3d(72.83352, -1.187484, -1.7e-33)), "72.8335, -1.18748, 0");
    EXPECT_EQ(place_text(Eigen::Vector3d(-4e-5, 6e-5, 1234567)), "0, 6e-05, 1.23457e+06");
}

TEST(PlaceText, NamesEightPlacesAndCountsTheOthers)
{
    std::vector<Eigen::Vector3d> places;
    EXPECT_EQ(place_text(places), "");
    for (int k = 1; k <= 8; ++k)
        places.emplace_back(k, 0, 0);
    EXPECT_EQ(place_text(std::span(places).first(2)), "1, 0, 0; 2, 0, 0");
    EXPECT_TRUE(place_text(places).ends_with("; 8, 0, 0"));
    places.insert(places.end(), 3, Eigen::Vector3d(9, 0, 0));
    EXPECT_TRUE(place_text(places).ends_with("; 8, 0, 0 and 3 more"));
}

} // namespace
} // namespace spia
