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

/// @param others  that many fields are no members, on purpose
template <class T> void expect_all_members(size_t others = 0)
{
    EXPECT_EQ(members<T> + others, fields<T>())
        << testing::internal::GetTypeName<T>()
        << " has a field that scripts and projects lose: give it a row in described<> beside the struct, or in "
           "members_of<> of app/viewer/model/actions/members.h";
}

} // namespace

// What is forgotten there is lost in scripts and projects without a word, and so it is in tests
// that compare their JSON.
TEST(Members, AreAllFieldsOfTheirStructs)
{
    expect_all_members<GltfNodes>();
    expect_all_members<CsvTables>();
    expect_all_members<OutputOptions>();
    expect_all_members<ReportTables>();
    expect_all_members<ViewerReportOptions>();
    expect_all_members<SeamOptions>();
    expect_all_members<Reading>();
    expect_all_members<RemeshOptions>(2); // all but what counts as a line
    expect_all_members<TensileOptions>();
    expect_all_members<MaterialFitOptions>();
    expect_all_members<GridOptions>();
    expect_all_members<FitChoice>();
    expect_all_members<LayoutOptions>(7); // all but what is the same for everybody
    expect_all_members<LatticeChoice>();
    expect_all_members<ControlMove>();
    expect_all_members<TargetPlane>();
    expect_all_members<TargetCylinder>();
    expect_all_members<TargetCone>();
    expect_all_members<StepTarget>();
    expect_all_members<LimitsChoice>();
    expect_all_members<ToolContact>();
    expect_all_members<StepFriction>();
    expect_all_members<OwnSheet>();
    expect_all_members<BeadShape>();
    expect_all_members<ProcessLine>();
    expect_all_members<Probe>();
    expect_all_members<FieldDisplay>();
    expect_all_members<Camera>();
    expect_all_members<ViewSettings>();
}

} // namespace spia::viewer
