// A file that appears under its name only when it is complete.
#pragma once

#include <filesystem>
#include <fstream>

#include "pliant/api.hpp"

namespace pliant {

/// Writes to a temporary file beside the target; `commit` gives it the target's name in one step.
/// Without a commit (an exception, an early return) the temporary is removed and an older target stays.
///
///     AtomicFile file(path);
///     file.stream() << "x,y\n";
///     file.commit();
class PLIANT_INSIDE AtomicFile {
public:
    /// Throws Error(bad_input) when the folder is missing or closed, or the target is no plain file.
    explicit AtomicFile(const std::filesystem::path& target);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// Binary, with the classic locale. Write errors need not be checked here: `commit` does.
    std::ostream& stream() { return stream_; }

    /// As it was asked for.
    const std::filesystem::path& path() const { return asked_for_; }

    /// Throws Error(bad_input) when anything could not be written; the target is then untouched.
    void commit();

private:
    std::filesystem::path asked_for_;  // as the caller named it, for messages
    std::filesystem::path target_;     // with symbolic links followed
    std::filesystem::path temporary_;
    std::ofstream stream_;
};

}  // namespace pliant
