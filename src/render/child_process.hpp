// A program that reads what is written to it.
#pragma once

#include <cstddef>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <sys/types.h>

namespace pliant {

/// Started without a shell, so that no argument is ever interpreted. What it says (standard error) is kept;
/// what it prints is dropped. It is waited for at the latest when this is destroyed: no zombie stays.
class ChildProcess {
public:
    /// Looks for `arguments[0]` on the path. Throws std::system_error when it cannot be started.
    explicit ChildProcess(const std::vector<std::string>& arguments);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// False when the program has stopped reading. Never raises SIGPIPE.
    bool write(const void* data, std::size_t size) noexcept;
    /// Ends its input, waits for it, and tells whether it succeeded.
    bool finish() noexcept;
    /// What it has said so far, without the white space at the end.
    std::string complaint() const;

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::unique_ptr<std::FILE, Close> said_;
    int input_ = -1;
    pid_t process_ = -1;
    bool succeeded_ = false;
};

}  // namespace pliant
