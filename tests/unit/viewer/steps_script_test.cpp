// The actions on steps as scripts say them, and what the report tells of steps.
#include <gtest/gtest.h>

#include "app/viewer/model/actions/script.h"
#include "app/viewer/model/reports/state_report.h"
#include "tests/unit/viewer/steps_fixture.h"

namespace spia::viewer {

TEST_F(UnfoldingSteps, ScriptsSayTheSameActions)
{
    open_box();
    const auto perform = [&](const char* text) {
        model.apply(action_from_json(parse_json(text, "test"), state));
        wait();
    };
    perform(R"({"do": "propose_steps"})");
    perform(R"({"do": "change_step", "step": 3, "tolerance": 1e-7})");
    EXPECT_EQ(document.steps[3]->tolerance, 1e-7);
    const std::string name = document.steps[3]->name;
    perform(R"({"do": "change_step", "step": 3, "within_mm": 0.1})");
    EXPECT_EQ(document.steps[3]->name, name) << "what is not given stays";
    EXPECT_EQ(document.steps[3]->tolerance, 1e-7);
    perform(R"({"do": "run_steps"})");
    perform(R"({"do": "show_step", "position": 3.25})");
    EXPECT_EQ(state.view.step, 3);
    const Json report = state_report(state)["unfolding"];
    EXPECT_EQ(report["done"], 5);
    EXPECT_EQ(report["position"], 3.25);
    EXPECT_EQ(report["steps"][3]["status"], "done");
    EXPECT_EQ(report["steps"][3]["on"], "plane");
    EXPECT_EQ(report["steps"][3]["freed"], document.steps[3]->pick.freed.size());
    EXPECT_EQ(report["steps"][3]["strain_equivalent"], document.unfolding->figure[3].strain_equivalent);
    EXPECT_GT(report["blank"]["size"][0], 100 + 2 * 30) << "with the lips it is wider than bottom and walls";
    for (const Action& action : {Action(ProposeSteps{7}), Action(RunSteps{}), Action(AddStep{2, 1, "a", {}}),
                                 Action(ChangeStep{1, "b", -2.5, 0.5, 12.5, 1e-6, {}}), Action(RemoveStep{3}),
                                 Action(MoveStep{1, 2}), Action(ShowStep{1, 0.5})})
        EXPECT_EQ(to_json(action_from_json(to_json(action), state)), to_json(action)) << to_json(action);
    perform(R"({"do": "remove_step", "step": 4})");
    perform(R"({"do": "move_step", "step": 0, "to": 2})");
    EXPECT_EQ(document.steps.size(), 4u);
    EXPECT_THROW(action_from_json(parse_json(R"({"do": "move_step", "step": 0})", "test")), InputError);
}

} // namespace spia::viewer
