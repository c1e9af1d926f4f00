#include "render/child_process.hpp"

#include <cerrno>
#include <csignal>
#include <system_error>

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX requires the program to declare it

namespace pliant {
namespace {

[[noreturn]] void fail(int error, const std::string& what)
{
    throw std::system_error(error, std::generic_category(), what);
}

/// File descriptors and signals of a new child.
struct SpawnOptions {
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;

    SpawnOptions(int input, int complaints)
    {
        posix_spawn_file_actions_init(&files);
        posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
        posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_adddup2(&files, complaints, STDERR_FILENO);
        // Its own process group: Ctrl-C ends only us; the child then sees the end of its input and completes
        // its file.
        posix_spawnattr_init(&attributes);
        posix_spawnattr_setflags(&attributes,
                                 POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
        posix_spawnattr_setpgroup(&attributes, 0);
        sigset_t none, pipe;
        sigemptyset(&none);
        sigemptyset(&pipe);
        sigaddset(&pipe, SIGPIPE);
        posix_spawnattr_setsigmask(&attributes, &none);
        posix_spawnattr_setsigdefault(&attributes, &pipe);
    }
    ~SpawnOptions()
    {
        posix_spawn_file_actions_destroy(&files);
        posix_spawnattr_destroy(&attributes);
    }
    SpawnOptions(const SpawnOptions&) = delete;
    SpawnOptions& operator=(const SpawnOptions&) = delete;
};

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments)
{
    // Standard error goes to an unnamed file: a pipe could fill up and block the child until we read it.
    said_.reset(std::tmpfile());
    if (!said_) fail(errno, "a temporary file");
    ::fcntl(::fileno(said_.get()), F_SETFD, FD_CLOEXEC);
    // A socket instead of a pipe, since only sockets can be written to without SIGPIPE.
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) fail(errno, "a socket");
    input_ = ends[0];
    ::shutdown(input_, SHUT_RD);

    std::vector<char*> words;
    for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);
    const SpawnOptions options(ends[1], ::fileno(said_.get()));
    const int error =
        ::posix_spawnp(&process_, words[0], &options.files, &options.attributes, words.data(), environ);
    ::close(ends[1]);
    if (error != 0) {
        ::close(input_);
        fail(error, arguments[0]);
    }
}

ChildProcess::~ChildProcess() { finish(); }

bool ChildProcess::write(const void* data, std::size_t size) noexcept
{
    const char* next = static_cast<const char*>(data);
    while (size > 0) {
        const ssize_t sent = ::send(input_, next, size, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) return false;
        next += sent;
        size -= static_cast<std::size_t>(sent);
    }
    return true;
}

bool ChildProcess::finish() noexcept
{
    if (process_ < 0) return succeeded_;
    ::close(input_);
    int status = 0;
    pid_t waited;
    do waited = ::waitpid(process_, &status, 0);
    while (waited < 0 && errno == EINTR);
    succeeded_ = waited == process_ && WIFEXITED(status) && WEXITSTATUS(status) == 0;
    process_ = -1;
    return succeeded_;
}

std::string ChildProcess::complaint() const
{
    std::string text(4096, '\0');
    const ssize_t size = ::pread(::fileno(said_.get()), text.data(), text.size(), 0);
    text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    text.resize(text.find_last_not_of(" \r\n") + 1);
    return text;
}

}  // namespace pliant
