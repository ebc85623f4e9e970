#include "pipeline/job_runner.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "partwise/base/atomic_file.h"
#include "partwise/base/read_bytes.h"
#include "partwise/base/test_folder.h"

namespace partwise::pipeline {
namespace {

namespace fs = std::filesystem;
using State = JobResult::State;
using testing::ElementsAre;
using testing::HasSubstr;

// Stands in for partwise: notes what it is asked for, and does little else.
constexpr char stand_in[] = R"sh(#!/bin/sh
verb=$1 from=$2 to=$3 before= json=
for word; do
  [ "$before" = --json ] && json=$word
  before=$word
done
echo "$verb ${from##*/}" >> "{folder}/asked"
case $verb in
  copy) cat "$from" > "$to" ;;
  mention) cat "$from" "{folder}/mentioned" > "$to" ;;
  both) cat "$from" "$4" > "$to" ;;
  refuse) echo "noise" >&2; echo "partwise: $from: is no good; change it" >&2; exit 1 ;;
  crash) kill -9 $$ ;;
  forget) ;;
  go_on) [ -e "$to/half" ] || { echo half > "$to/half"; exec sleep 60; }; cat "$to/half" "$from" > "$to/whole" ;;
esac
reads=
[ $verb = mention ] && reads="\"{folder}/mentioned\""
echo "{\"reads\": [$reads], \"parts\": 3}" > "$json"
)sh";

class Jobs : public testing::Test {
 protected:
  Jobs() {
    std::string script = stand_in;
    for (std::size_t at; (at = script.find("{folder}")) != std::string::npos;) script.replace(at, 8, folder().string());
    write_file(folder() / "partwise", script);
    fs::permissions(folder() / "partwise", fs::perms::owner_all);
    fs::create_directory(folder() / "out");
    for (const char* name : {"a", "b", "mentioned"}) write_file(folder() / name, std::string(name) + "\n");
  }

  const fs::path& folder() const { return folder_.path(); }
  fs::path out(const std::string& name) const { return folder() / "out" / name; }

  Job job(const std::string& name, const std::string& verb, const std::vector<fs::path>& inputs) const {
    Job result{.stage = "stage", .name = name, .words = {plain(verb), input(inputs.front()), output("made")}};
    if (inputs.size() > 1) result.words.push_back(input(inputs[1]));
    result.inputs = inputs;
    result.outputs = {"made"};
    return result;
  }

  // A copy of a, and a copy of that and b together.
  std::vector<Job> two() const {
    return {job("one", "copy", {folder() / "a"}), job("two", "both", {out("one/made"), folder() / "b"})};
  }

  std::vector<JobResult> results(const std::vector<Job>& jobs, const Progress& progress = {}, int threads = 2) {
    FileHashes hashes(folder() / "hashes");
    JobEvents events;
    events.fails = [this](const Job& job, const std::string& message) { said_.push_back(job.name + ": " + message); };
    std::vector<JobResult> found = run_jobs(place_, jobs, threads, hashes, events, progress);
    hashes.save();
    return found;
  }

  std::vector<State> states(const std::vector<Job>& jobs) {
    std::vector<State> found;
    for (const JobResult& each : results(jobs)) found.push_back(each.state);
    return found;
  }

  std::string asked() {
    const std::string text = fs::exists(folder() / "asked") ? read_bytes(folder() / "asked") : "";
    fs::remove(folder() / "asked");
    return text;
  }

  TestFolder folder_;
  Workplace place_{fs::canonical(folder_.path()) / "out", folder_.path() / "partwise", "1"};
  std::vector<std::string> said_;
};

TEST_F(Jobs, AreMadeOnceAndInOrder) {
  const std::vector<JobResult> first = results(two());
  EXPECT_EQ(first[0].state, State::made);
  EXPECT_EQ(first[1].record.report.dump(), R"({"parts":3})");
  EXPECT_THAT(first[1].record.words, ElementsAre("both", "one/made", "two/made", "../b"));
  EXPECT_EQ(read_bytes(out("two/made")), "a\nb\n");
  EXPECT_EQ(asked(), "copy a\nboth made\n");
  EXPECT_THAT(states(two()), ElementsAre(State::kept, State::kept));
  EXPECT_EQ(asked(), "");
  std::vector<std::string> left;
  for (const auto& each : fs::directory_iterator(folder() / "out")) left.push_back(each.path().filename());
  EXPECT_THAT(left, testing::UnorderedElementsAre("one", "two"));
}

TEST_F(Jobs, WhatChangesIsMadeAgainAndWhatStaysIsNot) {
  states(two());
  const std::string key = read_record(out("two"))->key();
  write_file(folder() / "b", "c\n");
  EXPECT_THAT(states(two()), ElementsAre(State::kept, State::made));
  EXPECT_EQ(read_bytes(out("two/made")), "a\nc\n");
  EXPECT_NE(read_record(out("two"))->key(), key);
  write_file(folder() / "b", "b\n");
  states(two());
  EXPECT_EQ(read_record(out("two"))->key(), key);

  write_file(out("one/made"), "spoilt\n");  // comes out as it was, so that nothing else has to be made
  asked();
  EXPECT_THAT(states(two()), ElementsAre(State::made, State::kept));
  EXPECT_EQ(asked(), "copy a\n");
  fs::remove(out("two/made"));
  EXPECT_THAT(states(two()), ElementsAre(State::kept, State::made));

  std::vector<Job> otherwise = two();
  otherwise[0].words.push_back(plain("--finer"));
  EXPECT_THAT(states(otherwise), ElementsAre(State::made, State::kept));
  otherwise[0].given = {{"settings", "1"}};
  EXPECT_THAT(states(otherwise), ElementsAre(State::made, State::kept));
  place_.version = "2";
  EXPECT_THAT(states(otherwise), ElementsAre(State::made, State::made));
}

TEST_F(Jobs, ForecastsSayWhatWouldBeMadeAndWhy) {
  FileHashes hashes(folder() / "hashes");
  auto forecast = forecast_jobs(place_, two(), hashes);
  EXPECT_EQ(forecast[0].reason, "it is not there");
  EXPECT_EQ(forecast[1].state, JobForecast::State::open);
  EXPECT_EQ(forecast[1].reason, "one");
  states(two());
  write_file(folder() / "b", "c\n");
  forecast = forecast_jobs(place_, two(), hashes);
  EXPECT_EQ(forecast[0].state, JobForecast::State::kept);
  EXPECT_EQ(forecast[1].reason, "../b has changed");
}

TEST_F(Jobs, WhatAVerbReadsUnaskedCountsToo) {
  const std::vector<Job> jobs = {job("one", "mention", {folder() / "a"})};
  EXPECT_EQ(results(jobs)[0].record.inputs.back().name, "../mentioned");
  EXPECT_THAT(states(jobs), ElementsAre(State::kept));
  write_file(folder() / "mentioned", "more\n");
  EXPECT_THAT(states(jobs), ElementsAre(State::made));
  EXPECT_EQ(read_bytes(out("one/made")), "a\nmore\n");
}

TEST_F(Jobs, AFailureHoldsUpWhatNeedsItAndNothingElse) {
  std::vector<Job> jobs = {job("bad", "refuse", {folder() / "a"}), job("after", "copy", {out("bad/made")}),
                           job("last", "copy", {out("after/made")}), job("good", "copy", {folder() / "b"})};
  const std::vector<JobResult> found = results(jobs);
  EXPECT_EQ(found[0].state, State::failed);
  EXPECT_THAT(found[0].message, HasSubstr("a: is no good; change it"));
  EXPECT_EQ(found[1].state, State::held);
  EXPECT_EQ(found[1].message, "bad");
  EXPECT_EQ(found[2].state, State::held);
  EXPECT_EQ(found[3].state, State::made);
  EXPECT_THAT(said_, ElementsAre("bad: " + found[0].message));
  EXPECT_FALSE(fs::exists(out("bad.unfinished")));

  jobs[1].without = [&](const std::set<std::string>& failed) {
    EXPECT_THAT(failed, ElementsAre("bad"));
    return job("after", "copy", {folder() / "b"});
  };
  EXPECT_THAT(states(jobs), ElementsAre(State::failed, State::made, State::made, State::kept));
}

TEST_F(Jobs, WhatEndsBadlyIsNamed) {
  const std::vector<JobResult> found =
      results({job("killed", "crash", {folder() / "a"}), job("empty", "forget", {folder() / "a"}),
               job("nowhere", "copy", {folder() / "gone"})});
  EXPECT_THAT(found[0].message, HasSubstr("signal 9"));
  EXPECT_THAT(found[1].message, HasSubstr("lacks made"));
  EXPECT_THAT(found[2].message, HasSubstr("gone"));
}

TEST_F(Jobs, AStopReachesTheVerbWhichGoesOnAfterwards) {
  Job slow{.stage = "stage", .name = "slow", .words = {plain("go_on"), input(folder() / "a"), output(".")}};
  slow.inputs = {folder() / "a"};
  slow.outputs = {"whole"};
  slow.goes_on = true;
  std::ptrdiff_t times = 1;
  Progress progress;
  progress.cancelled = [&] {
    if (!fs::exists(folder() / "asked") || !fs::exists(out("slow.unfinished/half"))) return false;
    return std::ranges::count(read_bytes(folder() / "asked"), '\n') == times;
  };
  const auto start = std::chrono::steady_clock::now();
  EXPECT_THROW(results({slow}, progress), Cancelled);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
  EXPECT_FALSE(fs::exists(out("slow")));
  write_file(out("slow.unfinished/rest.tmp"), "x");
  EXPECT_THAT(states({slow}), ElementsAre(State::made));
  EXPECT_EQ(read_bytes(out("slow/whole")), "half\na\n");
  EXPECT_FALSE(fs::exists(out("slow/rest.tmp")));

  fs::remove_all(out("slow"));  // begun from something else, it does not go on
  times = 3;
  EXPECT_THROW(results({slow}, progress), Cancelled);
  write_file(folder() / "a", "other\n");
  times = 4;
  EXPECT_THROW(results({slow}, progress), Cancelled);
  EXPECT_EQ(asked(), "go_on a\ngo_on a\ngo_on a\ngo_on a\n");
}

}  // namespace
}  // namespace partwise::pipeline
