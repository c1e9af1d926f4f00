// What a shared library shows of itself.
#pragma once

#if defined(__GNUC__)
/// Of a declaration that users link to.
#define PLIANT_API __attribute__((visibility("default")))
#else
#define PLIANT_API
#endif
/// Of one inside that another of the project's libraries links to. It is no part of the interface, and
/// changes without notice.
#define PLIANT_INSIDE PLIANT_API
