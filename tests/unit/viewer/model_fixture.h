#pragma once
#include <algorithm>
#include <chrono>
#include <gtest/gtest.h>
#include <string>
#include <thread>

#include "app/viewer/model/jobs/viewer_model.h"

namespace spia::viewer {

/// A model without a window, driven by actions alone. Parts begin with one patch, whose grid and
/// corners most tests are about.
struct ModelFixture : testing::Test {
    const std::filesystem::path assets = SPIA_SOURCE_DIR "/assets";
    ViewerModel model{assets};
    ModelFixture()
    {
        Preferences preferences = model.state().preferences;
        preferences.one_patch = true;
        model.apply(SetPreferences{preferences});
    }
    const ViewerState& state = model.state();
    const Document& document = state.document;

    void wait()
    {
        while (model.busy()) {
            model.poll();
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }
    void open(const char* part = "dome.obj")
    {
        model.apply(OpenPart{assets / "parts" / part, ""});
        wait();
        ASSERT_NE(document.session.part, nullptr);
    }
    bool says(Severity severity, const std::string& text) const
    {
        return std::any_of(state.messages.begin(), state.messages.end(), [&](const Message& m) {
            return m.severity == severity && m.text.find(text) != std::string::npos;
        });
    }
};

} // namespace spia::viewer
