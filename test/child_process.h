// A program that a test starts, listens to and ends.
#pragma once

#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <string>
#include <vector>

extern char** environ;

/// Whatever it does, it is over after its deadline: reading what it says needs none of its own.
class ChildProcess
{
public:
  /// @param command the program and its arguments
  /// @param deadline [s]
  ChildProcess(const std::vector<std::string>& command, int deadline)
  {
    std::vector<std::string> words = { "timeout", "--kill-after=5", std::to_string(deadline) };
    words.insert(words.end(), command.begin(), command.end());
    std::vector<char*> arguments;
    for (std::string& word : words)
    {
      arguments.push_back(&word[0]);
    }
    arguments.push_back(nullptr);

    int ends[2];
    EXPECT_EQ(pipe(ends), 0);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, ends[1], STDERR_FILENO);
    posix_spawn_file_actions_addclose(&files, ends[0]);
    EXPECT_EQ(posix_spawnp(&pid_, "timeout", &files, nullptr, arguments.data(), environ), 0);
    posix_spawn_file_actions_destroy(&files);
    close(ends[1]);
    output_ = fdopen(ends[0], "r");
  }

  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  ~ChildProcess()
  {
    if (pid_ > 0)
    {
      signal(SIGTERM);
      exitStatus();
    }
    std::fclose(output_);
  }

  /// The next line it says, without its end. @return whether there was one
  bool readLine(std::string& line)
  {
    line.clear();
    int c = std::fgetc(output_);
    const bool any = c != EOF;
    for (; c != EOF && c != '\n'; c = std::fgetc(output_))
    {
      line += static_cast<char>(c);
    }
    return any;
  }

  /// Reads on until a line holds `text`. @return whether one did
  /// @param[out] said gets all lines that were read, that one too
  bool says(const std::string& text, std::vector<std::string>* said = nullptr)
  {
    std::string line;
    while (readLine(line))
    {
      if (said != nullptr)
      {
        said->push_back(line);
      }
      if (line.find(text) != std::string::npos)
      {
        return true;
      }
    }
    return false;
  }

  /// All that it still says until it ends, by lines.
  std::vector<std::string> lines()
  {
    std::vector<std::string> all;
    for (std::string line; readLine(line);)
    {
      all.push_back(line);
    }
    return all;
  }

  /// The same in one text.
  std::string rest()
  {
    std::string all;
    for (const std::string& line : lines())
    {
      all += line + "\n";
    }
    return all;
  }

  /// timeout passes it on.
  void signal(int number) const { kill(pid_, number); }

  /// For signals that timeout cannot pass on: it gets them, too.
  void signalBoth(int number) const { kill(-pid_, number); }

  /// Waits for the end. @return 124 if the deadline ended it
  int exitStatus()
  {
    int status = -1;
    waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

private:
  pid_t pid_ = -1;
  std::FILE* output_ = nullptr;
};
