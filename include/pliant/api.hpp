// What a shared library shows of itself.
#pragma once

#if defined(__GNUC__)
/// Marks a declaration that users link to.
#define PLIANT_API __attribute__((visibility("default")))
#else
#define PLIANT_API
#endif
/// Marks an internal declaration that another of the project's libraries links to. It may change without
/// notice.
#define PLIANT_INSIDE PLIANT_API
