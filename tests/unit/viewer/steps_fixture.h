#pragma once
#include <numbers>
#include <string>
#include <vector>

#include "app/viewer/model/document/unfolding_steps.h"
#include "tests/support/bent_parts.h"
#include "tests/support/mesh_file.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/viewer/model_fixture.h"

namespace spia::viewer {

/// A model with a part to be unfolded step by step.
struct UnfoldingSteps : ModelFixture {
    ScratchFolder folder;

    std::string last(Severity severity) const
    {
        for (auto message = state.messages.rbegin(); message != state.messages.rend(); ++message)
            if (message->severity == severity && !message->dismissed)
                return message->text;
        return "";
    }
    void open_mesh(const TriMesh& mesh)
    {
        shapes::write_mesh(folder / "part.obj", mesh);
        model.apply(OpenPart{folder / "part.obj", ""});
        wait();
        ASSERT_NE(document.session.part, nullptr) << last(Severity::error);
    }
    /// A lying U: flat 20, bent over 5, flat 60 upright, bent over 5, flat 25 below the first; all
    /// 80 long.
    const shapes::DevelopablePart channel = shapes::extruded(shapes::Profile({0, 0}, 0)
                                                                 .straight(20)
                                                                 .bend(5, -std::numbers::pi / 2)
                                                                 .straight(60)
                                                                 .bend(5, -std::numbers::pi / 2)
                                                                 .straight(25),
                                                             80, 1500);
    void open_channel() { open_mesh(channel.mesh); }
    void open_box() { open_mesh(shapes::lipped_box()); }
    void propose(std::optional<int> keep = {})
    {
        model.apply(ProposeSteps{keep});
        wait();
    }
    void run()
    {
        model.apply(RunSteps{});
        wait();
    }
    const UnfoldState& after(size_t step) const { return document.unfolding->run.states[step]; }
    std::vector<std::string> names() const
    {
        std::vector<std::string> result;
        for (const auto& step : document.steps)
            result.push_back(step->name);
        return result;
    }
    std::vector<StepStatus> status() const
    {
        std::vector<StepStatus> result;
        for (size_t k = 0; k < document.steps.size(); ++k)
            result.push_back(step_status(document, k));
        return result;
    }
    ChangeStep change_of(int step) const
    {
        const PlannedStep& now = *document.steps[size_t(step)];
        return {step,
                now.name,
                now.offset_mm,
                now.within_mm,
                now.extent_mm,
                now.tolerance,
                {},
                numbers_of(now.pick.friction)};
    }
    /// Faces of the channel by what their normals say: the middle is horizontal.
    FaceSet with_height(double least, double greatest) const
    {
        const TriMesh& mesh = document.session.part->mesh;
        FaceSet faces;
        for (int f = 0; f < mesh.triangles(); ++f) {
            const double z = mesh.position(Eigen::all, mesh.triangle.col(f)).row(2).mean();
            if (z >= least && z <= greatest)
                faces.push_back(f);
        }
        return faces;
    }
};

} // namespace spia::viewer
