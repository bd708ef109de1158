#pragma once
#include <cstdlib>
#include <gtest/gtest.h>
#include <iterator>
#include <optional>
#include <string>

#include "tests/unit/exchange/scratch_folder.h"

namespace spia::viewer {

/// A home folder of its own for one test.
class OwnHome : public ::testing::Test {
protected:
    OwnHome()
    {
        for (size_t i = 0; i < std::size(names_); ++i)
            if (const char* value = std::getenv(names_[i]))
                before_[i] = value;
        ::setenv("HOME", (folder / "").c_str(), 1);
        ::unsetenv("XDG_CONFIG_HOME");
        ::unsetenv("XDG_STATE_HOME");
    }
    ~OwnHome() override
    {
        for (size_t i = 0; i < std::size(names_); ++i)
            before_[i] ? ::setenv(names_[i], before_[i]->c_str(), 1) : ::unsetenv(names_[i]);
    }

    ScratchFolder folder;

private:
    static constexpr const char* names_[] = {"HOME", "XDG_CONFIG_HOME", "XDG_STATE_HOME"};
    std::optional<std::string> before_[3];
};

} // namespace spia::viewer
