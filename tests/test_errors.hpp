// What actions throw.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "pliant/error.hpp"

namespace pliant::test {

/// The Error that an action ends with, or one of no kind.
template <class Action>
Error error_of(Action action)
{
    try {
        action();
    } catch (const Error& error) {
        return error;
    }
    return {ErrorKind{}, "no error"};
}

}  // namespace pliant::test

/// The action throws an Error of the kind, whose message has the part.
#define EXPECT_ERROR(action, expected_kind, part)                                             \
    do {                                                                                      \
        const ::pliant::Error error_ = ::pliant::test::error_of([&] { action; });             \
        EXPECT_EQ(error_.kind, ::pliant::ErrorKind::expected_kind) << error_.what();          \
        EXPECT_NE(std::string(error_.what()).find(part), std::string::npos) << error_.what(); \
    } while (false)
