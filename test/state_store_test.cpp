// Claims about where saved states are kept: names, limits, and files that are whole or not there.
#include "cloth_tearing/node/state_store.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <thread>

#include "cloth_tearing/core/refusal.h"

namespace cloth_tearing
{
namespace
{

namespace files = std::filesystem;

std::string reason(const std::function<void()>& work)
{
  try
  {
    work();
    return "";
  }
  catch (const cloth::Refusal& refusal)
  {
    return refusal.what();
  }
}

bool has(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

/// A folder that is gone in the end.
class StateFiles : public ::testing::Test
{
protected:
  StateFiles()
  {
    std::string pattern = (files::temp_directory_path() / "cloth_states_XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    params_.folder = folder_ + "/of/states";
  }
  ~StateFiles() override { files::remove_all(folder_); }

  std::string path(const std::string& name) const { return params_.folder + "/" + name + ".cloth"; }

  int filesThere() const
  {
    return static_cast<int>(
        std::distance(files::directory_iterator(params_.folder), files::directory_iterator()));
  }

  std::string folder_;
  StateStoreParams params_;
};

TEST(StateStore, KeepsStatesUnderTheirNames)
{
  StateStore store{ StateStoreParams() };
  store.keep("a", "first");
  store.keep("B-2_c.d", "second");
  store.keep("a", "third");
  EXPECT_EQ(*store.kept("a"), "third");
  EXPECT_EQ(*store.kept("B-2_c.d"), "second");
}

TEST(StateStore, RefusesNamesThatNothingHas)
{
  const StateStore store{ StateStoreParams() };
  EXPECT_TRUE(has(reason([&] { store.kept("a"); }), "no state \"a\""));
}

TEST_F(StateFiles, RefusesNamesThatAreNone)
{
  StateStore store(params_);
  for (const std::string& name :
       { std::string(), std::string("."), std::string(".a"), std::string("../a"),
         std::string("a/b"), std::string("a b"), std::string("a\0b", 3), std::string("\xc3\xa4"),
         std::string("a\n"), std::string(65, 'a') })
  {
    EXPECT_TRUE(has(reason([&] { store.keep(name, "x"); }), "name is")) << name;
    EXPECT_TRUE(has(reason([&] { store.kept(name); }), "name is")) << name;
    EXPECT_TRUE(has(reason([&] { store.write(name, "x"); }), "name is")) << name;
    EXPECT_TRUE(has(reason([&] { store.read(name); }), "name is")) << name;
  }
  EXPECT_FALSE(files::exists(params_.folder));
  EXPECT_EQ(reason([&] { store.keep(std::string(64, 'a'), "x"); }), "");
}

TEST(StateStore, RefusesMoreStatesThanItsLimit)
{
  StateStoreParams params;
  params.max_states = 2;
  StateStore store(params);
  store.keep("a", "1");
  store.keep("b", "2");
  EXPECT_TRUE(has(reason([&] { store.keep("c", "3"); }), "max_states is 2"));
  EXPECT_EQ(reason([&] { store.keep("b", "4"); }), "") << "in place of another it is no more";
}

TEST_F(StateFiles, RefusesMoreBytesThanItsLimit)
{
  params_.max_state_memory = 1.0;
  StateStore store(params_);
  store.keep("a", std::string(600000, 'x'));
  EXPECT_TRUE(has(reason([&] { store.keep("b", std::string(600000, 'x')); }),
                  "1.2 MB, max_state_memory is 1 MB"));
  EXPECT_EQ(reason([&] { store.keep("a", std::string(900000, 'x')); }), "");
  EXPECT_TRUE(
      has(reason([&] { store.write("a", std::string(1000001, 'x')); }), "max_state_memory"));

  store.write("b", "small");
  files::resize_file(path("b"), 2000000);
  EXPECT_TRUE(has(reason([&] { store.read("b"); }), "max_state_memory is 1 MB"));
}

TEST_F(StateFiles, ReadsWhatItWrote)
{
  const std::string bytes("with\0 zeros and\nlines", 21);
  StateStore(params_).write("a", bytes);
  EXPECT_EQ(*StateStore(params_).read("a"), bytes);
  EXPECT_TRUE(files::exists(path("a")));
  StateStore(params_).write("a", "");
  EXPECT_EQ(*StateStore(params_).read("a"), "");
  EXPECT_EQ(filesThere(), 1) << "nothing is left behind";
}

TEST_F(StateFiles, AreWholeWhoeverReadsThemMeanwhile)
{
  const StateStore store(params_);
  store.write("a", std::string(100000, 'x'));
  std::thread writer(
      [&]
      {
        for (int i = 0; i < 100; ++i)
        {
          store.write("a", std::string(100000, i % 2 == 0 ? 'y' : 'x'));
        }
      });
  for (int i = 0; i < 300; ++i)
  {
    const StateStore::Bytes bytes = store.read("a");
    ASSERT_EQ(bytes->size(), 100000u);
    ASSERT_EQ(bytes->find_first_not_of(bytes->front()), std::string::npos);
  }
  writer.join();
}

TEST_F(StateFiles, AreRefusedWithPathAndReason)
{
  const StateStore store(params_);
  const std::string missing = reason([&] { store.read("a"); });
  EXPECT_TRUE(has(missing, path("a")) && has(missing, "No such file")) << missing;

  files::create_directories(path("b"));
  EXPECT_TRUE(has(reason([&] { store.read("b"); }), "no file"));
  EXPECT_TRUE(has(reason([&] { store.write("b", "x"); }), path("b")));
  ASSERT_EQ(mkfifo(path("c").c_str(), 0600), 0);
  EXPECT_TRUE(has(reason([&] { store.read("c"); }), "no file"));
  EXPECT_EQ(filesThere(), 2) << "nothing is left behind";

  std::ofstream(folder_ + "/file") << "in the way";
  params_.folder = folder_ + "/file/states";
  const std::string blocked = reason([&] { StateStore(params_).write("a", "x"); });
  EXPECT_TRUE(has(blocked, params_.folder) && has(blocked, "Not a directory")) << blocked;
}

TEST(StateStore, HasNoFilesWithoutAFolder)
{
  const StateStore store{ StateStoreParams() };
  EXPECT_TRUE(has(reason([&] { store.write("a", "x"); }), "state_folder is empty"));
  EXPECT_TRUE(has(reason([&] { store.read("a"); }), "state_folder is empty"));
}

TEST(StateStoreParams, AreRefusedByName)
{
  EXPECT_TRUE(problems(StateStoreParams()).empty());
  StateStoreParams params;
  params.folder = "relative";
  params.max_states = 0;
  params.max_state_memory = 0.0;
  const std::vector<std::string> found = problems(params);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_TRUE(has(found[0], "state_folder"));
  EXPECT_TRUE(has(found[1], "max_states"));
  EXPECT_TRUE(has(found[2], "max_state_memory"));
}

}  // namespace
}  // namespace cloth_tearing
