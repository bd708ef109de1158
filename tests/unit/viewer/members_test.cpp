#include "app/viewer/model/actions/members.h"

#include <gtest/gtest.h>
#include <tuple>
#include <type_traits>

namespace spia::viewer {
namespace {

/// Stands for a value of any type.
struct Anything {
    template <class T> operator T() const; // NOLINT(google-explicit-constructor)
};

template <class T, class... Value>
concept MadeFrom = requires
{
    T{Value{}...};
};

/// How many fields an aggregate has: the most values that it can be made from.
template <class T, class... Value> constexpr size_t fields()
{
    if constexpr (MadeFrom<T, Value..., Anything>)
        return fields<T, Value..., Anything>();
    else
        return sizeof...(Value);
}

template <class T> constexpr size_t members = std::tuple_size_v<std::remove_cvref_t<decltype(members_of<T>)>>;

struct Three {
    int a;
    std::array<double, 4> b;
    std::optional<std::string> c;
};
static_assert(fields<Three>() == 3);

} // namespace

// What is forgotten there is lost in scripts and projects without a word, and so it is in tests
// that compare their JSON.
TEST(Members, AreAllFieldsOfTheirStructs)
{
    EXPECT_EQ(members<GltfNodes>, fields<GltfNodes>());
    EXPECT_EQ(members<CsvTables>, fields<CsvTables>());
    EXPECT_EQ(members<OutputOptions>, fields<OutputOptions>());
    EXPECT_EQ(members<ReportTables>, fields<ReportTables>());
    EXPECT_EQ(members<ViewerReportOptions>, fields<ViewerReportOptions>());
    EXPECT_EQ(members<SeamOptions>, fields<SeamOptions>());
    EXPECT_EQ(members<Reading>, fields<Reading>());
    EXPECT_EQ(members<RemeshOptions>, fields<RemeshOptions>() - 2) << "all but what counts as a line";
    EXPECT_EQ(members<TensileOptions>, fields<TensileOptions>());
    EXPECT_EQ(members<MaterialFitOptions>, fields<MaterialFitOptions>());
    EXPECT_EQ(members<GridOptions>, fields<GridOptions>());
    EXPECT_EQ(members<FitChoice>, fields<FitChoice>());
    EXPECT_EQ(members<LayoutOptions>, fields<LayoutOptions>() - 7) << "all but what is the same for everybody";
    EXPECT_EQ(members<LatticeChoice>, fields<LatticeChoice>());
    EXPECT_EQ(members<ControlMove>, fields<ControlMove>());
    EXPECT_EQ(members<TargetPlane>, fields<TargetPlane>());
    EXPECT_EQ(members<TargetCylinder>, fields<TargetCylinder>());
    EXPECT_EQ(members<TargetCone>, fields<TargetCone>());
    EXPECT_EQ(members<StepTarget>, fields<StepTarget>());
    EXPECT_EQ(members<LimitsChoice>, fields<LimitsChoice>());
    EXPECT_EQ(members<ToolContact>, fields<ToolContact>());
    EXPECT_EQ(members<StepFriction>, fields<StepFriction>());
    EXPECT_EQ(members<OwnSheet>, fields<OwnSheet>());
    EXPECT_EQ(members<BeadShape>, fields<BeadShape>());
    EXPECT_EQ(members<ProcessLine>, fields<ProcessLine>());
    EXPECT_EQ(members<Probe>, fields<Probe>());
    EXPECT_EQ(members<FieldDisplay>, fields<FieldDisplay>());
    EXPECT_EQ(members<Camera>, fields<Camera>());
    EXPECT_EQ(members<ViewSettings>, fields<ViewSettings>());
}

} // namespace spia::viewer
