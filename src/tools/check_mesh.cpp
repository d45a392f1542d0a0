// Command check_mesh: says what the importer makes of model files.
#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "cloth_tearing/core/obj_reader.h"

namespace
{

constexpr int ACCEPTED = 0;
constexpr int REFUSED = 1;
constexpr int WRONG_USAGE = 2;

const char USAGE[] =
    "usage: check_mesh [--scale S] [--weld-distance D] FILE...\n"
    "\n"
    "Says what becomes of each OBJ file when it is imported as cloth: counts, pieces, borders,\n"
    "size, and what was mended, dropped or ignored, with the line.\n"
    "\n"
    "  --scale S          metres per unit of the file, above 0 (default 1)\n"
    "  --weld-distance D  join vertices up to D metres apart (default 0: join by index alone)\n"
    "  --help             show this text\n"
    "\n"
    "Exit status: 0 all files are accepted, 1 a file is refused, 2 wrong usage.\n";

struct Arguments
{
  cloth::ImportOptions options;
  std::vector<std::string> files;
  bool help = false;
};

double numberAfter(const std::string& option, const std::string& text)
{
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0')
  {
    throw std::invalid_argument(option + " needs a number, not \"" + text + "\"");
  }
  return number;
}

Arguments parse(const std::vector<std::string>& words)
{
  Arguments arguments;
  const std::map<std::string, double*> numbers = {
    { "--scale", &arguments.options.scale },
    { "--weld-distance", &arguments.options.weld_distance },
  };
  bool options_ended = false;
  for (std::size_t i = 0; i < words.size(); ++i)
  {
    const std::string& word = words[i];
    const auto number = numbers.find(word);
    if (options_ended || word.size() < 2 || word.compare(0, 1, "-") != 0)
    {
      arguments.files.push_back(word);
    }
    else if (word == "--")
    {
      options_ended = true;
    }
    else if (word == "--help" || word == "-h")
    {
      arguments.help = true;
    }
    else if (number == numbers.end())
    {
      throw std::invalid_argument("unknown option " + word);
    }
    else if (++i == words.size())
    {
      throw std::invalid_argument(word + " needs a number");
    }
    else
    {
      *number->second = numberAfter(word, words[i]);
    }
  }
  for (const std::string& problem : problems(arguments.options))
  {
    throw std::invalid_argument(problem);
  }
  if (arguments.files.empty() && !arguments.help)
  {
    throw std::invalid_argument("no file is given");
  }
  return arguments;
}

std::string counted(int count, const std::string& thing, const std::string& things)
{
  return std::to_string(count) + " " + (count == 1 ? thing : things);
}

// A finding without its numbers: what those of one kind have in common.
std::string kindOf(const std::string& text)
{
  std::string kind;
  for (std::size_t i = 0; i < text.size();)
  {
    const bool number = text[i] >= '0' && text[i] <= '9';
    kind += number ? '#' : text[i];
    const std::size_t end = number ? text.find_first_not_of("0123456789.e+-", i) : i + 1;
    i = std::min(end, text.size());
  }
  return kind;
}

// Lines in rising order, as "3-7, 9"; after the first few places "...".
class Places
{
public:
  void add(int line)
  {
    if (ranges_.empty() || line > ranges_.back().second + 1)
    {
      ranges_.emplace_back(line, line);
    }
    ranges_.back().second = line;
  }

  std::string text() const
  {
    std::string text;
    for (std::size_t i = 0; i < std::min(ranges_.size(), SHOWN); ++i)
    {
      const auto& [first, last] = ranges_[i];
      text += (i == 0 ? "" : ", ") + std::to_string(first);
      text += last > first ? "-" + std::to_string(last) : "";
    }
    return text + (ranges_.size() > SHOWN ? ", ..." : "");
  }

private:
  static constexpr std::size_t SHOWN = 5;

  std::vector<std::pair<int, int>> ranges_;
};

// Findings of one kind are one line, with the words of the first.
void printFindings(const std::vector<cloth::ImportFinding>& findings)
{
  struct Group
  {
    std::string text;
    bool alike = false;  // other numbers in the others
    int count = 0;
    Places places;
  };
  std::vector<Group> groups;
  std::map<std::string, std::size_t> index_of_kind;
  for (const cloth::ImportFinding& finding : findings)
  {
    const auto found = index_of_kind.emplace(kindOf(finding.text), groups.size());
    if (found.second)
    {
      groups.push_back({ finding.text, false, 0, {} });
    }
    Group& group = groups[found.first->second];
    group.alike = group.alike || finding.text != group.text;
    ++group.count;
    group.places.add(finding.line);
  }
  for (const Group& group : groups)
  {
    std::cout << "    " << (group.count == 1 ? "line " : "lines ") << group.places.text() << ": "
              << group.text;
    if (group.count > 1)
    {
      std::cout << " (" << group.count << (group.alike ? " like this)" : " times)");
    }
    std::cout << "\n";
  }
}

void print(const std::string& file, const cloth::ImportReport& report)
{
  const cloth::Vec3d size = report.highest - report.lowest;
  std::cout << file << ": accepted\n"
            << "  file:     " << counted(report.vertices, "vertex", "vertices") << ", "
            << counted(report.texture_vertices, "texture vertex", "texture vertices") << ", "
            << counted(report.faces, "face", "faces") << "\n"
            << "  cloth:    " << counted(report.particles, "particle", "particles") << ", "
            << counted(report.springs, "spring", "springs") << ", "
            << counted(report.triangles, "triangle", "triangles") << ", "
            << counted(report.pieces, "piece", "pieces") << "\n"
            << "  borders:  " << report.borders << ", of "
            << counted(report.border_springs, "spring", "springs") << "; "
            << counted(report.seam_edges, "texture seam edge", "texture seam edges") << "\n"
            << "  size:     " << size.x() << " x " << size.y() << " x " << size.z() << " m, area "
            << report.area << " m^2\n"
            << "  edges:    " << report.shortest_edge << " to " << report.longest_edge
            << " m, least altitude of a triangle " << report.least_altitude << " m\n"
            << "  mended:   " << counted(report.welded_vertices, "vertex", "vertices")
            << " welded, " << counted(report.collapsed_edges, "edge", "edges") << " collapsed, "
            << counted(report.dropped_faces, "face", "faces") << " dropped, "
            << counted(report.turned_faces, "face", "faces") << " turned over, "
            << counted(report.unused_vertices, "vertex", "vertices") << " left out\n";
  if (report.findings.empty())
  {
    std::cout << "  findings: none\n";
    return;
  }
  std::cout << "  findings:\n";
  printFindings(report.findings);
  for (const int count : { report.welded_vertices, report.collapsed_edges, report.dropped_faces,
                           report.turned_faces, report.unused_vertices })
  {
    if (count > cloth::MAX_FINDINGS_KEPT)
    {
      std::cout << "    of each kind only the first " << cloth::MAX_FINDINGS_KEPT
                << " are listed\n";
      break;
    }
  }
}

int check(const Arguments& arguments)
{
  int status = ACCEPTED;
  for (const std::string& file : arguments.files)
  {
    try
    {
      print(file, cloth::readObjFile(file, arguments.options).report);
    }
    catch (const cloth::ImportError& error)
    {
      std::cout << error.what() << "\n";
      status = REFUSED;
    }
  }
  return status;
}

}  // namespace

int main(int argc, char** argv)
{
  try
  {
    const Arguments arguments = parse(std::vector<std::string>(argv + 1, argv + argc));
    if (arguments.help)
    {
      std::cout << USAGE;
      return ACCEPTED;
    }
    return check(arguments);
  }
  catch (const std::invalid_argument& error)
  {
    std::cerr << "check_mesh: " << error.what() << "\n\n" << USAGE;
    return WRONG_USAGE;
  }
}
