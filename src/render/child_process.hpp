// A child program that reads from us.
#pragma once

#include <cstddef>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <sys/types.h>

namespace pliant {

/// Started without a shell, so arguments are never interpreted. Its standard error is kept, its standard
/// output discarded. The destructor waits for it, so no zombie remains.
class ChildProcess {
public:
    /// Searches the PATH for `arguments[0]`. Throws std::system_error if it cannot be started.
    explicit ChildProcess(const std::vector<std::string>& arguments);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// False if the program has stopped reading. Never raises SIGPIPE.
    bool write(const void* data, std::size_t size) noexcept;
    /// Closes its input, waits for it, and returns whether it succeeded.
    bool finish() noexcept;
    /// Its standard error so far, without trailing white space.
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
