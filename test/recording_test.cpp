// Claims about recordings: what was recorded comes again, bit for bit, and what is left of one that
// was cut, damaged or killed is as much of the run as was written.
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <set>
#include <sstream>

#include "child_process.h"
#include "cloth_tearing/core/recorded_calls.h"
#include "cloth_tearing/core/recording_file.h"
#include "cloth_tearing/core/replay.h"
#include "scenes.h"

namespace cloth
{
namespace
{

const bool THOROUGH = std::getenv("CLOTH_TEARING_THOROUGH") != nullptr;

/// Keeps what is appended where the test sees it, until it is full.
class Memory : public RecordSink
{
public:
  explicit Memory(std::string& bytes, std::size_t room = std::string::npos)
      : bytes_(bytes), room_(room)
  {
  }

  void append(const std::string& bytes) override
  {
    if (bytes.size() > room_ - bytes_.size())
    {
      throw Refusal("no room");
    }
    bytes_ += bytes;
  }

private:
  std::string& bytes_;
  std::size_t room_;
};

/// A sheet that hangs by its upper edge and tears easily.
RecordedStart frailSheet(int cells)
{
  RecordedStart start;
  const ClothModel flat = sheet(1.0, 1.0, cells, cells);
  start.model = upright(flat);
  start.pinned = edgeOf(flat, "top");
  start.params.material.areal_density = 0.15;
  start.params.environment.wind = Vec3d(0.3, 1.1, 0.2);
  start.params.tearing.tear_strain = 0.2;
  start.params.tearing.weak_tear_strain = 0.15;
  start.params.life = 7;
  start.params.place = "in world at (0, 0, 1)";
  return start;
}

Simulation built(const RecordedStart& start)
{
  return { start.model, start.pinned, start.params };
}

std::shared_ptr<Recorder> recorderInto(std::string& bytes, const RecordedStart& start)
{
  return std::make_shared<Recorder>(std::make_unique<Memory>(bytes), start,
                                    [](const std::string& problem) { ADD_FAILURE() << problem; });
}

/// At the lower edge of the sheet as built, so many particles from its corner.
GraspRequest atEdge(const Simulation& simulation, const RecordedStart& start, int from_corner = 0)
{
  GraspRequest request;
  const std::size_t corner = start.model.positions.size() - 1;
  request.point = simulation.cloth().state.position[corner - from_corner].cast<double>();
  request.radius = 0.2;
  request.frame.position = request.point;
  request.force_limit = 500.0;
  return request;
}

PinRequest roundTheSeventh(const Simulation& simulation)
{
  return { simulation.cloth().state.position[7].cast<double>(), 0.05, { 8 } };
}

DragTarget aside()
{
  DragTarget target;
  target.pose.position = Vec3d(0.9, -0.6, -1.3);
  target.linear_speed = 2.0;
  target.angular_speed = 3.0;
  return target;
}

Sphere ball()
{
  Sphere sphere;
  sphere.id = 3;
  sphere.center = Vec3d(0.1, -0.4, -0.6);
  sphere.radius = 0.3;
  sphere.velocity = Vec3d(0.0, 0.5, 0.0);
  return sphere;
}

Pose shifted(const Pose& pose)
{
  Pose shifted = pose;
  shifted.position += Vec3d(-0.02, -0.05, -0.03);
  return shifted;
}

/// What users do, in this order, with steps between: every call at least once.
std::vector<std::function<void(Simulation&)>> everyCall(const RecordedStart& start)
{
  using S = Simulation;
  const auto saved = std::make_shared<std::string>();
  return {
    [](S& s) { s.setSpheres({ ball() }); },
    [start](S& s) { s.grasp(atEdge(s, start)); },
    [](S& s) { s.drag(1, aside()); },
    [saved](S& s) { *saved = s.save(); },
    [](S& s) { s.moveSphere(3, Vec3d(0.1, -0.2, -0.6), 0.05); },
    [](S& s) {
      s.throwSphere({ Vec3d(0.2, -0.5, -0.4), Vec3d(0.2, 7.0, 0.1), 0.1, 0.4, 1.0 });
    },
    [](S& s) { s.steer(1, shifted(s.findGrasp(1).pose), 0.02); },
    [](S& s) {
      s.pull({ 1, aside(), 400.0, 50, false });
    },
    [](S& s) { s.cancelPull(1); },
    [](S& s) { s.holdSphere(SphereSource::STREAMED, 3, Vec3d(0.0, -0.5, -0.5)); },
    [](S& s) { s.letGoOfSphere(SphereSource::STREAMED, 3); },
    [](S& s) { s.throwAtCloth(SphereSource::STREAMED, 3, 6.0); },
    [](S& s) { s.release(1, "enough", AfterGrasp::PINNED); },
    [start](S& s)
    {
      GraspRequest following = atEdge(s, start, 3);
      following.followed = "hand";
      s.grasp(following);
    },
    [](S& s) { s.follow(2, shifted(s.findGrasp(2).pose), 0.02); },
    [](S& s) { s.frameLost(2, "no hand"); },
    [](S& s) { s.frameFound(2); },
    [](S& s) { s.stopFollowing(2); },
    [](S& s) { s.releaseAll(); },
    [](S& s) { s.pin(roundTheSeventh(s)); },
    [](S& s) { s.unpin(roundTheSeventh(s)); },
    [](S& s)
    {
      Tuning tuning = tuningOf(s.params());
      tuning.material.stiffness *= 1.2;
      tuning.environment.wind.y() = -2.0;
      s.tune(tuning);
    },
    [](S& s) { s.place(s.cloth().state.position); },
    [](S& s) { s.throwSphere({}); },
    [](S& s) { s.removeSphere(SphereSource::THROWN, s.spheres().back().id); },
    [saved](S& s) { s.restore(*saved); },
    [](S& s) { s.reset(); },
    [start](S& s)
    {
      RecordedStart other = frailSheet(5);
      other.params = start.params;
      s.takeCloth(built(other));
    },
    [](S& s) {
      s.throwSphere({ Vec3d(0.1, -0.5, -0.4), Vec3d(0.0, 9.0, 0.0), 0.15, 0.0, 1.0 });
    },
  };
}

/// All of that with `steps` steps after each. @return the hash after each step
std::vector<std::uint64_t> doEverything(Simulation& simulation, const RecordedStart& start,
                                        int steps)
{
  std::vector<std::uint64_t> hashes;
  for (const auto& call : everyCall(start))
  {
    call(simulation);
    for (int i = 0; i < steps; ++i)
    {
      simulation.step();
      hashes.push_back(simulation.stateHash());
    }
  }
  return hashes;
}

struct RecordedRun
{
  std::string bytes;
  std::vector<std::uint64_t> hashes;  ///< after each step
};

/// Recorded.
RecordedRun everything(int cells, int steps)
{
  RecordedRun run;
  const RecordedStart start = frailSheet(cells);
  Simulation simulation = built(start);
  simulation.recordTo(recorderInto(run.bytes, start));
  run.hashes = doEverything(simulation, start, steps);
  return run;
}

/// Plays to the end. @return why it went no further; empty if it did
std::string replayed(const std::string& bytes, std::vector<std::uint64_t>& hashes)
{
  try
  {
    std::istringstream stream(bytes);
    Replay replay(stream);
    while (replay.step())
    {
      hashes.push_back(replay.simulation().stateHash());
    }
    return {};
  }
  catch (const Refusal& refusal)
  {
    return refusal.what();
  }
}

std::string replayed(const std::string& bytes)
{
  std::vector<std::uint64_t> hashes;
  return replayed(bytes, hashes);
}

/// Where its records end [byte].
std::vector<std::uint64_t> recordEnds(const std::string& bytes, std::vector<Record>& records)
{
  std::istringstream stream(bytes);
  RecordReader reader(stream);
  std::vector<std::uint64_t> ends;
  while (std::optional<Record> record = reader.next())
  {
    records.push_back(std::move(*record));
    ends.push_back(reader.position());
  }
  EXPECT_EQ(reader.leftOver(), 0u);
  return ends;
}

TEST(Recording, ComesAgainBitForBitWithEveryLog)
{
  const RecordedStart start = frailSheet(8);
  std::string bytes;
  Simulation simulation = built(start);
  simulation.recordTo(recorderInto(bytes, start));
  doEverything(simulation, start, 20);
  ASSERT_GT(simulation.loggedTears()[1], 20u);

  std::istringstream stream(bytes);
  Replay replay(stream);
  while (replay.step())
  {
  }

  const Simulation& again = replay.simulation();
  EXPECT_EQ(again.stateHash(), simulation.stateHash());
  EXPECT_EQ(again.save(), simulation.save());
  EXPECT_EQ(again.time(), simulation.time());
  EXPECT_EQ(again.epoch(), simulation.epoch());
  EXPECT_EQ(again.loggedTears(), simulation.loggedTears());
  EXPECT_EQ(again.loggedGraspEvents(), simulation.loggedGraspEvents());
  EXPECT_EQ(again.loggedPullEnds(), simulation.loggedPullEnds());
  EXPECT_EQ(replay.tears(), simulation.loggedTears()[1]);
  EXPECT_EQ(replay.leftOver(), 0u);
}

TEST(Recording, KnowsEveryCallOfTheList)
{
  std::vector<Record> records;
  recordEnds(everything(4, 1).bytes, records);
  std::set<int> called;
  for (const Record& record : records)
  {
    if (record.kind == RecordKind::CALL)
    {
      called.insert(record.bytes.front());
    }
  }
  EXPECT_EQ(static_cast<int>(called.size()), Simulation::Calls::count(Simulation::Calls::All()));
}

TEST(Recording, ChangesNothing)
{
  const RecordedStart start = frailSheet(8);
  Simulation unrecorded = built(start);
  EXPECT_EQ(doEverything(unrecorded, start, 5), everything(8, 5).hashes);
}

TEST(Recording, HoldsNeitherRefusedCallsNorWhatCopiesDo)
{
  const RecordedStart start = frailSheet(4);
  std::string bytes;
  Simulation simulation = built(start);
  simulation.recordTo(recorderInto(bytes, start));
  const std::string before = bytes;

  EXPECT_THROW(simulation.release(5), Refusal);
  EXPECT_THROW(simulation.throwSphere({ Vec3d::Zero(), Vec3d::Zero(), -1.0, 0.0, 1.0 }), Refusal);
  EXPECT_THROW(simulation.restore("nothing"), Refusal);
  Simulation copy = simulation;
  copy.grasp(atEdge(copy, start));
  run(copy, 5);

  EXPECT_EQ(bytes, before);
  simulation = std::move(copy);
  simulation.step();
  EXPECT_GT(bytes.size(), before.size()) << "what is assigned to it is recorded on";
}

TEST(Recording, BringsAFaultAgain)
{
  RecordedStart start = frailSheet(6);
  start.params.max_speed = 3.0;
  std::string bytes;
  Simulation simulation = built(start);
  simulation.recordTo(recorderInto(bytes, start));
  simulation.throwSphere({ Vec3d(0.1, -0.5, -0.4), Vec3d(0.0, 9.0, 0.0), 0.15, 0.0, 1.0 });
  std::string fault;
  for (int i = 0; i < 1000 && fault.empty(); ++i)
  {
    fault = simulation.step().fault;
  }
  ASSERT_NE(fault.find("max_speed"), std::string::npos) << fault;

  std::istringstream stream(bytes);
  Replay replay(stream);
  while (replay.step())
  {
  }

  EXPECT_EQ(replay.faults(), 1u);
  EXPECT_EQ(replay.simulation().stateHash(), simulation.stateHash());
}

std::uint64_t wholeRecords(const std::string& bytes)
{
  std::istringstream stream(bytes);
  RecordReader reader(stream);
  std::uint64_t whole = 0;
  while (reader.next())
  {
    ++whole;
  }
  return whole;
}

TEST(Recording, CutAtAnyByteIsTheRunUpToThere)
{
  const RecordedRun run = everything(3, 1);
  std::vector<Record> records;
  const std::vector<std::uint64_t> ends = recordEnds(run.bytes, records);
  std::size_t whole = 0;
  std::size_t steps = 0;
  for (std::size_t cut = sizeof RECORDING_MAGIC; cut <= run.bytes.size(); ++cut)
  {
    const std::string left = run.bytes.substr(0, cut);
    const bool another = ends[whole] == cut;
    steps += another && records[whole].kind == RecordKind::STEP ? 1 : 0;
    whole += another ? 1 : 0;
    ASSERT_EQ(wholeRecords(left), whole) << "cut at byte " << cut;
    if (another)
    {
      std::vector<std::uint64_t> hashes;
      ASSERT_EQ(replayed(left, hashes), "") << "cut at byte " << cut;
      ASSERT_EQ(hashes.size(), steps) << "cut at byte " << cut;
      ASSERT_TRUE(std::equal(hashes.begin(), hashes.end(), run.hashes.begin())) << cut;
    }
  }
  EXPECT_EQ(whole, records.size());
}

TEST(Recording, CutInItsBeginningIsRefused)
{
  const RecordedRun run = everything(3, 1);
  EXPECT_NE(replayed(run.bytes.substr(0, 5)).find("no recording"), std::string::npos);
  EXPECT_NE(replayed(run.bytes.substr(0, 500)).find("ends before"), std::string::npos);
  EXPECT_NE(replayed("").find("no recording"), std::string::npos);
}

TEST(Recording, WithAnyByteDamagedIsRefusedFromThatRecordOn)
{
  const RecordedRun run = everything(3, 1);
  std::vector<Record> records;
  const std::vector<std::uint64_t> ends = recordEnds(run.bytes, records);
  for (std::size_t at = sizeof RECORDING_MAGIC; at < run.bytes.size(); ++at)
  {
    std::string damaged = run.bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ (at % 2 == 0 ? 0x01 : 0x80));
    std::istringstream stream(damaged);
    RecordReader reader(stream);
    const auto before = std::upper_bound(ends.begin(), ends.end(), at) - ends.begin();
    for (std::ptrdiff_t i = 0; i < before; ++i)
    {
      ASSERT_TRUE(reader.next()) << "damage at byte " << at;
    }
    ASSERT_THROW(reader.next(), Refusal) << "damage at byte " << at << " was not seen";
  }
}

TEST(Recording, MissesNoRecordThatIsLostDoubledOrMoved)
{
  const RecordedRun run = everything(3, 1);
  std::vector<Record> records;
  const std::vector<std::uint64_t> ends = recordEnds(run.bytes, records);
  const auto record = [&](std::size_t i)
  { return run.bytes.substr(ends[i - 1], ends[i] - ends[i - 1]); };
  const std::string begun = run.bytes.substr(0, ends[4]);
  const std::string after = run.bytes.substr(ends[6]);
  for (const std::string& changed :
       { begun + after, begun + record(5) + record(5) + record(6) + after,
         begun + record(6) + record(5) + after })
  {
    EXPECT_NE(replayed(changed).find("damaged"), std::string::npos);
  }
}

/// With checksums that are right: as if the simulation had done something else since.
TEST(Recording, TellsWhereARunDiffers)
{
  std::vector<Record> records;
  recordEnds(everything(8, 20).bytes, records);
  std::string bytes(RECORDING_MAGIC, sizeof RECORDING_MAGIC);
  RecordWriter writer;
  const char throws = Simulation::Calls::numberOf<&Simulation::throwSphere>();
  for (const Record& record : records)
  {
    if (record.kind != RecordKind::CALL || record.bytes.front() != throws)
    {
      bytes += writer.framed(record.kind, record.bytes);
    }
  }
  const std::string reason = replayed(bytes);
  EXPECT_NE(reason.find("differs"), std::string::npos) << reason;
  EXPECT_NE(reason.find("after "), std::string::npos) << reason;
}

TEST(Recording, EndsWhereThereIsNoRoomAndTheSimulationGoesOn)
{
  const RecordedRun whole = everything(4, 3);
  const RecordedStart start = frailSheet(4);
  std::string bytes;
  std::vector<std::string> problems;
  Simulation simulation = built(start);
  simulation.recordTo(
      std::make_shared<Recorder>(std::make_unique<Memory>(bytes, whole.bytes.size() / 2), start,
                                 [&](const std::string& problem) { problems.push_back(problem); }));

  EXPECT_EQ(doEverything(simulation, start, 3), whole.hashes);

  EXPECT_EQ(problems, std::vector<std::string>{ "no room" });
  EXPECT_EQ(bytes, whole.bytes.substr(0, bytes.size()));
  std::vector<std::uint64_t> hashes;
  EXPECT_EQ(replayed(bytes, hashes), "");
  EXPECT_GT(hashes.size(), 5u);
  EXPECT_TRUE(std::equal(hashes.begin(), hashes.end(), whole.hashes.begin()));
}

TEST(Recording, ThatDoesNotEvenTakeItsBeginningIsNone)
{
  const RecordedStart start = frailSheet(4);
  std::string bytes;
  EXPECT_THROW(Recorder(std::make_unique<Memory>(bytes, 100), start, nullptr), Refusal);
}

TEST(Recording, ComparesHashesFromTheFirstStepOn)
{
  const RecordedRun run = everything(4, 1);
  std::istringstream stream(run.bytes);
  Replay replay(stream);
  while (replay.step())
  {
  }
  EXPECT_EQ(replay.steps(), 29u);
  EXPECT_EQ(replay.hashes(), 5u) << "after 1, 2, 4, 8 and 16 steps";
  EXPECT_EQ(replay.lastHash(), 16u);
}

/// A path that nothing has yet, and that is free again in the end.
class NewPath
{
public:
  explicit NewPath(const std::string& name)
      : path_(testing::TempDir() + name + std::to_string(getpid()))
  {
    std::remove(path_.c_str());
  }
  ~NewPath() { std::remove(path_.c_str()); }

  const std::string& get() const { return path_; }

  std::string content() const
  {
    std::ifstream file(path_, std::ios::binary);
    std::ostringstream bytes;
    bytes << file.rdbuf();
    return bytes.str();
  }

private:
  std::string path_;
};

std::string reasonAgainst(const std::function<void()>& work)
{
  try
  {
    work();
    return "";
  }
  catch (const Refusal& refusal)
  {
    return refusal.what();
  }
}

TEST(RecordingFile, ReplacesNothing)
{
  const NewPath path("recording");
  std::ofstream(path.get()) << "mine";
  const std::string reason = reasonAgainst([&] { RecordingFile(path.get(), 100); });
  EXPECT_NE(reason.find(path.get() + ": File exists"), std::string::npos) << reason;
  EXPECT_EQ(path.content(), "mine");
}

TEST(RecordingFile, NeverGetsLongerThanItsLimit)
{
  const NewPath path("recording");
  RecordingFile file(path.get(), 10);
  file.append("1234567");
  const std::string reason = reasonAgainst([&] { file.append("89ab"); });
  EXPECT_NE(reason.find("must not have more than 10"), std::string::npos) << reason;
  file.append("89a");
  EXPECT_EQ(path.content(), "123456789a");
}

/// The kernel writes as much as there is room for, and says so.
TEST(RecordingFile, HoldsNoPartOfWhatFindsNoRoomOnTheDisk)
{
  const NewPath path("recording");
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit little{ 1000, before.rlim_max };
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &little), 0);
  RecordingFile file(path.get(), 1000000);
  file.append(std::string(600, 'a'));
  const std::string reason = reasonAgainst([&] { file.append(std::string(600, 'b')); });
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);

  EXPECT_NE(reason.find("cannot write the recording " + path.get()), std::string::npos) << reason;
  EXPECT_EQ(path.content(), std::string(600, 'a'));
  file.append("c");
  EXPECT_EQ(path.content(), std::string(600, 'a') + "c");
}

/// What a process tells its parent even when it is killed.
class SharedCount
{
public:
  SharedCount()
  {
    void* const memory = mmap(nullptr, sizeof(std::atomic<std::uint64_t>), PROT_READ | PROT_WRITE,
                              MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    count_ = new (memory) std::atomic<std::uint64_t>(0);
  }
  SharedCount(const SharedCount&) = delete;
  SharedCount& operator=(const SharedCount&) = delete;
  ~SharedCount() { munmap(count_, sizeof *count_); }

  std::atomic<std::uint64_t>& operator*() { return *count_; }

private:
  std::atomic<std::uint64_t>* count_;
};

/// Records until it is killed. Counts the steps that are over.
[[noreturn]] void stepForEver(const std::string& path, std::atomic<std::uint64_t>& steps)
{
  alarm(30);  // whatever becomes of the parent
  const RecordedStart start = frailSheet(6);
  Simulation simulation = built(start);
  simulation.recordTo(std::make_shared<Recorder>(std::make_unique<RecordingFile>(path, 1u << 30),
                                                 start, [](const std::string&) { _exit(1); }));
  simulation.grasp(atEdge(simulation, start));
  simulation.drag(1, aside());
  for (;;)
  {
    simulation.setSpheres({ ball() });
    simulation.step();
    ++steps;
  }
}

TEST(RecordingFile, LosesNoStepToAKill)
{
  const int kills = THOROUGH ? 500 : 50;
  std::uint64_t most = 0;
  for (int i = 0; i < kills; ++i)
  {
    const NewPath path("recording");
    SharedCount steps;
    const pid_t child = fork();
    if (child == 0)
    {
      stepForEver(path.get(), *steps);
    }
    const std::uint64_t wanted = 1 + 17 * static_cast<std::uint64_t>(i % 50);
    int status = 0;
    while (*steps < wanted && waitpid(child, &status, WNOHANG) == 0)
    {
    }
    kill(child, SIGKILL);
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) << status;

    std::istringstream stream(path.content());
    Replay replay(stream);
    while (replay.step())
    {
    }
    ASSERT_GE(replay.steps(), *steps) << "kill " << i;
    ASSERT_LE(replay.steps(), *steps + 1) << "kill " << i;
    most = std::max(most, replay.steps());
  }
  EXPECT_GT(most, 500u);
}

std::string said(const std::vector<std::string>& arguments, int& status)
{
  std::vector<std::string> command = { REPLAY_RECORDING };
  command.insert(command.end(), arguments.begin(), arguments.end());
  ChildProcess program(command, 30);
  const std::string all = program.rest();
  status = program.exitStatus();
  return all;
}

TEST(ReplayRecording, SaysWhetherARunIsTheSame)
{
  const NewPath path("recording");
  const NewPath state("state");
  const RecordedRun run = everything(6, 10);
  std::ofstream(path.get(), std::ios::binary) << run.bytes << "cut";
  int status = -1;

  const std::string all = said({ path.get() }, status);
  EXPECT_EQ(status, 0) << all;
  EXPECT_NE(all.find(std::to_string(run.hashes.size()) + " steps"), std::string::npos) << all;
  EXPECT_NE(all.find("state hash " + std::to_string(run.hashes.back())), std::string::npos) << all;
  EXPECT_NE(all.find("The last 3 bytes"), std::string::npos) << all;

  const std::string some = said({ "--steps", "25", "--save", state.get(), path.get() }, status);
  EXPECT_EQ(status, 0) << some;
  EXPECT_NE(some.find("state hash " + std::to_string(run.hashes[24])), std::string::npos) << some;
  EXPECT_EQ(built(frailSheet(6)).restored(state.content()).stateHash(), run.hashes[24]);

  std::string damaged = run.bytes;
  damaged[damaged.size() / 2] ^= 1;
  std::ofstream(path.get(), std::ios::binary) << damaged;
  EXPECT_NE(said({ path.get() }, status).find("is damaged"), std::string::npos);
  EXPECT_EQ(status, 1);
  const std::string both = said({ path.get(), path.get() }, status);
  EXPECT_EQ(status, 1) << both;
  EXPECT_NE(both.find("after "), std::string::npos) << both;
}

TEST(ReplayRecording, RefusesWrongUsage)
{
  int status = -1;
  EXPECT_NE(said({}, status).find("no file"), std::string::npos);
  EXPECT_EQ(status, 2);
  EXPECT_NE(said({ "--steps", "-3", "x" }, status).find("needs a number"), std::string::npos);
  EXPECT_EQ(status, 2);
  EXPECT_NE(said({ "/nowhere/at/all" }, status).find("cannot read"), std::string::npos);
  EXPECT_EQ(status, 1);
  EXPECT_NE(said({ "--help" }, status).find("usage:"), std::string::npos);
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace cloth
