#include "end_to_end/process_tree.hpp"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <thread>

namespace breccia::test {
namespace {

namespace fs = std::filesystem;

/// Inodes of the sockets that a process has open.
std::set<std::string> sockets_of(pid_t process) {
  std::set<std::string> inodes;
  std::error_code error;
  for (fs::directory_iterator entry("/proc/" + std::to_string(process) + "/fd", error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code gone;
    const std::string link = fs::read_symlink(entry->path(), gone).string();
    if (link.starts_with("socket:[")) inodes.insert(link.substr(8, link.size() - 9));
  }
  return inodes;
}

}  // namespace

pid_t start_process(const std::string& command) {
  const pid_t process = fork();
  if (process == 0) {
    const std::string quiet = "exec > /dev/null 2>&1 < /dev/null; " + command;
    execl("/bin/sh", "sh", "-c", quiet.c_str(), nullptr);
    _exit(127);
  }
  return process;
}

void forget_network_settings() {
  for (const char* name : {"OMPI_MCA_btl", "OMPI_MCA_mtl", "OMPI_MCA_osc", "OMPI_MCA_pml"}) unsetenv(name);
  setenv("OMPI_MCA_mca_base_param_files", "/dev/null", 1);
}

std::vector<pid_t> tree_below(pid_t process) {
  std::vector<pid_t> all{process};
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::ifstream file("/proc/" + std::to_string(all[i]) + "/task/" + std::to_string(all[i]) + "/children");
    for (pid_t child = 0; file >> child;) all.push_back(child);
  }
  return all;
}

std::string name_of(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/comm");
  std::string name;
  std::getline(file, name);
  return name;
}

std::string open_listeners(pid_t process) {
  constexpr const char* kListening = "0A";
  const std::set<std::string> own = sockets_of(process);
  std::string found;
  for (const char* table : {"tcp", "tcp6"}) {
    std::ifstream file("/proc/" + std::to_string(process) + "/net/" + table);
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
      std::istringstream words(line);
      std::string number, local, remote, state, queues, timer, retransmits, user, timeout, inode;
      words >> number >> local >> remote >> state >> queues >> timer >> retransmits >> user >> timeout >> inode;
      // 127.0.0.0/8 and ::1, as the kernel writes them; an address of IPv4 in one of IPv6 ends with it.
      const std::string address = local.substr(0, local.find(':'));
      const bool loopback = address.ends_with("7F") || address == "00000000000000000000000001000000";
      if (state == kListening && own.contains(inode) && !loopback) found += local + " ";
    }
  }
  return found;
}

void end_tree(pid_t process) {
  for (const pid_t one : tree_below(process)) kill(one, SIGKILL);
  waitpid(process, nullptr, 0);
}

bool wait_until(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

}  // namespace breccia::test
