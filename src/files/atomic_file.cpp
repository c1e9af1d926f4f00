#include "files/atomic_file.hpp"

#include <array>
#include <charconv>
#include <cstdint>
#include <locale>
#include <random>
#include <string>
#include <system_error>

#include "pliant/error.hpp"

namespace pliant {

namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& reason)
{
    throw Error(ErrorKind::bad_input, "cannot write '" + file.string() + "': " + reason);
}

/// Short for any target, and unique for every writer in the same folder.
std::string temporary_name()
{
    std::random_device random;
    const std::uint64_t number = (std::uint64_t{random()} << 32) | random();
    std::array<char, 16> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number, 16).ptr;
    return ".pliant-" + std::string(digits.data(), end) + ".part";
}

}  // namespace

AtomicFile::AtomicFile(const std::filesystem::path& target) : asked_for_(target), target_(target)
{
    std::error_code ignored;
    const auto status = std::filesystem::status(target, ignored);
    if (std::filesystem::is_directory(status)) fail(target, "it is a folder; give the name of a file");
    // Renaming onto a device or pipe would replace it.
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
        fail(target, "it exists and is not a regular file; give another name");
    if (std::filesystem::is_symlink(target, ignored))
        target_ = std::filesystem::weakly_canonical(target, ignored);

    const auto folder = target_.parent_path();
    if (!folder.empty() && !std::filesystem::is_directory(folder, ignored))
        fail(target, "there is no folder '" + folder.string() + "'; create it first");

    const auto temporary = folder / temporary_name();
    stream_.imbue(std::locale::classic());
    stream_.open(temporary, std::ios::binary | std::ios::trunc);
    if (!stream_) fail(target, "its folder does not allow new files; check the permissions");
    temporary_ = temporary;
}

AtomicFile::~AtomicFile()
{
    if (temporary_.empty()) return;
    stream_.close();
    std::error_code ignored;
    std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::commit()
{
    stream_.close();  // flushes; sets failbit when the last bytes could not be written
    if (!stream_) fail(asked_for_, "it could not be written completely; check the free space of the disk");
    std::error_code error;
    std::filesystem::rename(temporary_, target_, error);
    if (error) fail(asked_for_, "the finished file could not be renamed to it (" + error.message() + ")");
    temporary_.clear();
}

void write_text_file(const std::filesystem::path& target, const std::string& text)
{
    AtomicFile file(target);
    file.stream() << text;
    file.commit();
}

}  // namespace pliant
