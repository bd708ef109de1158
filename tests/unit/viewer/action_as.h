#pragma once
#include <gtest/gtest.h>

#include "app/viewer/model/actions/actions.h"

namespace spia::viewer {

/// The action as one of this kind; it is a failure if it is of another.
template <class T> T as(const Action& action)
{
    EXPECT_TRUE(action.is<T>());
    return action.is<T>() ? *action.as<T>() : T{};
}

} // namespace spia::viewer
