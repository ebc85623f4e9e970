#include <fmt/format.h>

#include <algorithm>

#include "partwise/appearance/material/material_files.h"
#include "partwise/appearance/rendering/environment_light.h"
#include "partwise/geometry/text_scanner.h"
#include "pipeline/stages.h"

namespace partwise::pipeline {
namespace {

namespace fs = std::filesystem;

bool is_photo(const fs::path& file) {
  const std::string ending = file.extension().string();
  return std::ranges::any_of(std::initializer_list<const char*>{".png", ".jpg", ".jpeg"},
                             [&](const char* each) { return equals_ignoring_case(ending, each); });
}

// What is done with some photos.
struct PhotoWork {
  std::vector<NamedFile> photos;
  fs::path mask;                       // empty: none
  std::vector<std::string> materials;  // shipped ones by name, or absolute files
  std::string light;                   // the same; empty: that which the photo shows
  bool refine = false, normals = false;
};

// A shipped thing by its name, or a file.
std::string shipped_or_file(const Places& places, const JsonFields& fields, const std::string& field,
                            const std::string& name, const std::vector<std::string>& shipped, bool is_file) {
  if (std::ranges::binary_search(shipped, name)) return name;
  std::error_code error;
  const fs::path file = absolute_file(places.folder, name);
  if (!is_file || !fs::is_regular_file(file, error)) {
    fields.refuse(field, fmt::format("\"{}\" is none that ships, and no file", name), "correct it");
  }
  return file.string();
}

PhotoWork take_work(const Places& places, const std::string& place, const nlohmann::json& section) {
  JsonFields fields = places.object(place, section);
  PhotoWork work;
  work.photos = take_files(fields, "photo", "except", places.folder, is_photo);
  fields.find("except");
  if (fields.has("mask")) {
    if (work.photos.size() > 1) fields.refuse("mask", "is one for many photos", "name them one by one, with theirs");
    work.mask = take_file(fields, "mask", places.folder);
  }
  if (fields.has("materials")) {
    const std::vector<std::string> shipped = shipped_materials();
    for (const std::string& name : fields.texts("materials")) {
      work.materials.push_back(shipped_or_file(places, fields, "materials", name, shipped, is_material_file(name)));
    }
  }
  if (fields.has("light")) {
    const std::string name = fields.text("light");
    work.light = shipped_or_file(places, fields, "light", name, shipped_lights(), is_light_file(name));
  }
  work.refine = fields.truth("refine", false);
  work.normals = fields.truth("normals", false);
  fields.refuse_others();
  if (work.materials.empty() && !work.normals) {
    fields.refuse("", "asks for nothing", "give \"materials\", or \"normals\": true");
  }
  if (work.materials.empty() && (work.refine || !work.light.empty())) {
    fields.refuse(work.refine ? "refine" : "light", "is of edits alone", "leave it out, or give \"materials\"");
  }
  return work;
}

void add_file(Job& job, const char* option, const fs::path& file) {
  if (file.empty()) return;
  job.words.push_back(plain(option));
  job.words.push_back(input(file));
  job.inputs.push_back(file);
}

// One thread each: many photos side by side are faster, and bytes then depend on no number of threads.
Job photo_job(const char* stage, const char* verb, const NamedFile& photo, const std::string& what,
              const PhotoWork& work, const fs::path& weights) {
  Job job{
      .stage = stage, .name = fmt::format("photos/{}/{}", photo.name, what), .words = {plain(verb), input(photo.file)}};
  job.inputs = {photo.file};
  job.threads = 1;
  add_file(job, "--mask", work.mask);
  add_file(job, "--weights", weights);
  return job;
}

Job edit(const NamedFile& photo, const std::string& material, const PhotoWork& work, const fs::path& weights) {
  const auto add = [](Job& job, const char* option, const std::string& name) {
    if (fs::path(name).is_absolute()) return add_file(job, option, name);
    job.words.push_back(plain(option));
    job.words.push_back(plain(name));
  };
  Job job = photo_job("edits", "edit", photo, fs::path(material).stem().string(), work, weights);
  add(job, "--material", material);
  if (!work.light.empty()) add(job, "--light", work.light);
  if (work.refine) job.words.push_back(plain("--refine"));
  for (const Word& word : {plain("--layers"), output("layers"), plain("-o"), output("edited.png")}) {
    job.words.push_back(word);
  }
  job.outputs = {"edited.png"};
  return job;
}

Job normals(const NamedFile& photo, const PhotoWork& work, const fs::path& weights) {
  Job job = photo_job("normals", "normals", photo, "normals", work, weights);
  job.words.push_back(plain("-o"));
  job.words.push_back(output("normals.png"));
  job.outputs = {"normals.png"};
  return job;
}

}  // namespace

std::vector<Job> photos_section(const Places& places, const Networks& networks, const nlohmann::json& section) {
  if (!section.is_array() || section.empty()) {
    places.object("", nlohmann::json::object()).refuse("photos", "is no list", "write [{\"photo\": ...}]");
  }
  std::vector<Job> edits, all_normals;
  for (std::size_t i = 0; i < section.size(); ++i) {
    const PhotoWork work = take_work(places, fmt::format("photos[{}]", i), section[i]);
    for (const NamedFile& photo : work.photos) {
      for (const std::string& material : work.materials) edits.push_back(edit(photo, material, work, networks.editing));
      if (!work.normals) continue;
      all_normals.push_back(normals(photo, work, networks.normals.empty() ? networks.editing : networks.normals));
    }
  }
  edits.insert(edits.end(), all_normals.begin(), all_normals.end());
  return edits;
}

}  // namespace partwise::pipeline
