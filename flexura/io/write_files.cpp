#include "flexura/io/write_files.hpp"

#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <fstream>
#include <map>
#include <system_error>

#include <fmt/format.h>

namespace flexura {
namespace {

namespace fs = std::filesystem;

std::string failure(const fs::path& path, const std::string& cause) {
  return fmt::format("Cannot write '{}': {}.", path.string(), cause);
}

std::string cause_of(int error_number) { return std::generic_category().message(error_number); }

/// Removes what was made for the files unless told to keep it.
class Undo {
 public:
  Undo() = default;
  Undo(const Undo&) = delete;
  Undo& operator=(const Undo&) = delete;
  ~Undo() {
    std::error_code ignored;  // nothing better can be done about a failing clean-up
    for (const fs::path& file : files_) fs::remove(file, ignored);
    // Innermost first; a folder that something else is in stays.
    for (const fs::path& folder : folders_) fs::remove(folder, ignored);
  }
  void add_file(const fs::path& file) { files_.push_back(file); }
  void add_folder(const fs::path& folder) { folders_.insert(folders_.begin(), folder); }
  void keep_all() {
    files_.clear();
    folders_.clear();
  }

 private:
  std::vector<fs::path> files_;
  std::vector<fs::path> folders_;
};

/// Makes a folder and those above it, outermost first; returns an error sentence or nothing.
std::string make_folder(const fs::path& folder, Undo& undo) {
  std::error_code error;
  if (folder.empty() || fs::is_directory(folder, error)) return {};
  std::string above = make_folder(folder.parent_path(), undo);
  if (!above.empty()) return above;
  if (fs::create_directory(folder, error)) undo.add_folder(folder);
  return error ? failure(folder, error.message()) : std::string();
}

/// An error names the target: the temporary name would mean nothing to the reader.
std::string write_whole(const fs::path& file, const std::string& content, const fs::path& target) {
  errno = 0;
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream.write(content.data(), static_cast<std::streamsize>(content.size()));
  stream.close();  // a full disk may show only now
  if (stream) return {};
  return failure(target, errno != 0 ? cause_of(errno) : "the system gave no reason");
}

/// Whether a name is one that write_files gave in a process that is gone: it was killed meanwhile.
bool is_leftover(const std::string& name, const std::string& target) {
  const std::string start = "." + target + ".";
  constexpr std::string_view end = ".part";
  if (!name.starts_with(start) || !name.ends_with(end) || name.size() <= start.size() + end.size())
    return false;
  const std::string number = name.substr(start.size(), name.size() - start.size() - end.size());
  if (number.size() > 9 || number.find_first_not_of("0123456789") != std::string::npos)
    return false;
  return kill(std::stoi(number), 0) != 0 && errno == ESRCH;
}

/// Removes them where the files are about to be written.
void remove_leftovers(const fs::path& folder, const std::vector<OutputFile>& files) {
  std::map<fs::path, std::vector<fs::path>> found;  // by the folder they are in
  for (const OutputFile& file : files) {
    const fs::path target = folder / file.name;
    const auto [at, is_new] = found.try_emplace(target.parent_path());
    std::error_code error;
    if (is_new)
      for (const auto& entry : fs::directory_iterator(target.parent_path(), error))
        if (entry.path().extension() == ".part") at->second.push_back(entry.path());
    for (const fs::path& part : at->second)
      if (is_leftover(part.filename().string(), target.filename().string()))
        fs::remove(part, error);
  }
}

/// Beside the target, so that the renaming stays on one file system, and of this process only.
fs::path temporary_name(const fs::path& target) {
  return target.parent_path() / fmt::format(".{}.{}.part", target.filename().string(), getpid());
}

}  // namespace

WriteOutcome write_files(const fs::path& folder, const std::vector<OutputFile>& files) {
  remove_leftovers(folder, files);
  Undo undo;
  for (const OutputFile& file : files) {
    const fs::path target = folder / file.name;
    const fs::path temporary = temporary_name(target);
    std::string error = make_folder(target.parent_path(), undo);
    if (!error.empty()) return {error};
    undo.add_file(temporary);
    error = write_whole(temporary, file.make ? file.make() : file.content, target);
    if (!error.empty()) return {error};
  }
  for (const OutputFile& file : files) {
    std::error_code ignored;
    const fs::path target = folder / file.name;
    if (fs::is_directory(target, ignored)) {
      return {failure(target, "a folder of that name is in the way")};
    }
  }
  for (const OutputFile& file : files) {
    const fs::path target = folder / file.name;
    std::error_code error;
    fs::rename(temporary_name(target), target, error);
    if (error) return {failure(target, error.message())};
  }
  undo.keep_all();
  return {};
}

}  // namespace flexura
