// A file that appears under its name only when it is complete.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "pliant/api.hpp"

namespace pliant {

/// Writes to a temporary file beside the target; `commit` renames it to the target. Without a commit (an
/// exception, an early return) the temporary file is removed and an existing target is unchanged.
///
///     AtomicFile file(path);
///     file.stream() << "x,y\n";
///     file.commit();
class PLIANT_INSIDE AtomicFile {
public:
    /// Throws Error(bad_input) if the folder is missing or not writable, or the target is not a regular file.
    explicit AtomicFile(const std::filesystem::path& target);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// Binary, with the classic locale. Write errors need not be checked here: `commit` does.
    std::ostream& stream() { return stream_; }

    /// As given by the caller.
    const std::filesystem::path& path() const { return asked_for_; }

    /// Throws Error(bad_input) if anything could not be written; the target is then unchanged.
    void commit();

private:
    std::filesystem::path asked_for_;  // as given by the caller, for messages
    std::filesystem::path target_;     // with symbolic links resolved
    std::filesystem::path temporary_;
    std::ofstream stream_;
};

/// Writes a whole file with an AtomicFile, and throws as that does.
PLIANT_INSIDE void write_text_file(const std::filesystem::path& target, const std::string& text);

}  // namespace pliant
