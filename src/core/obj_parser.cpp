// Lines, words, numbers and indices of a Wavefront OBJ file.
#include "cloth_tearing/core/obj_parser.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <locale>
#include <map>
#include <sstream>

#include "cloth_tearing/core/checks.h"

namespace cloth
{
namespace
{

// A part of the text; views keep a long file from being copied word by word.
struct Words
{
  const char* begin;
  const char* end;

  bool empty() const { return begin == end; }
  std::size_t size() const { return static_cast<std::size_t>(end - begin); }
  bool is(const char* other) const
  {
    return size() == std::strlen(other) && std::equal(begin, end, other);
  }
};

constexpr std::size_t MAX_WORD_SHOWN = 40;

bool isSpace(char c)
{
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

bool isDigit(char c)
{
  return c >= '0' && c <= '9';
}

// A word of the file, safe to print on a terminal.
std::string quoted(const Words& word)
{
  std::string text;
  for (const char* c = word.begin; c != word.end && text.size() < MAX_WORD_SHOWN; ++c)
  {
    const bool printable = static_cast<unsigned char>(*c) >= 32 && *c != 127;
    text += printable ? *c : '?';
  }
  return "\"" + text + (word.size() > MAX_WORD_SHOWN ? "...\"" : "\"");
}

// Takes the next word from the front of `rest`; empty at the end of the line.
Words nextWord(Words& rest)
{
  while (!rest.empty() && isSpace(*rest.begin))
  {
    ++rest.begin;
  }
  Words word = { rest.begin, rest.begin };
  while (word.end != rest.end && !isSpace(*word.end))
  {
    ++word.end;
  }
  rest.begin = word.end;
  return word;
}

// Where the comment of a line starts: at a # that no word holds, as 1.#INF does.
const char* commentIn(const Words& line)
{
  for (const char* c = line.begin; c != line.end; ++c)
  {
    if (*c == '#' && (c == line.begin || isSpace(c[-1])))
    {
      return c;
    }
  }
  return line.end;
}

// Goes through the text line by line, joining those that end with a backslash.
class LineReader
{
public:
  explicit LineReader(const std::string& text) : next_(text.data()), end_(text.data() + text.size())
  {
    const char byte_order_mark[] = "\xEF\xBB\xBF";
    if (text.compare(0, 3, byte_order_mark) == 0)
    {
      next_ += 3;
    }
  }

  bool read(Words& line)
  {
    if (next_ == end_)
    {
      return false;
    }
    number_ = next_number_;
    line = readOne();
    if (!continues(line))
    {
      return true;
    }
    joined_.clear();
    while (continues(line))
    {
      joined_.append(line.begin, line.end - 1);
      joined_ += ' ';
      line = next_ == end_ ? Words{ end_, end_ } : readOne();
    }
    joined_.append(line.begin, line.end);
    line = { joined_.data(), joined_.data() + joined_.size() };
    return true;
  }

  int number() const { return number_; }  // of the first of joined lines

private:
  Words readOne()
  {
    const Words line = { next_,
                         std::find_if(next_, end_, [](char c) { return c == '\n' || c == '\r'; }) };
    next_ = line.end;
    if (next_ != end_)
    {
      const bool two_characters = *next_ == '\r' && next_ + 1 != end_ && next_[1] == '\n';
      next_ += two_characters ? 2 : 1;
    }
    ++next_number_;
    return line;
  }

  // A path in a comment may well end with a backslash.
  static bool continues(const Words& line)
  {
    return !line.empty() && line.end[-1] == '\\' && commentIn(line) == line.end;
  }

  const char* next_;
  const char* end_;
  int next_number_ = 1;
  int number_ = 0;
  std::string joined_;
};

enum class NumberKind
{
  FINITE,
  NOT_FINITE,
  NOT_A_NUMBER
};

struct Number
{
  NumberKind kind = NumberKind::NOT_A_NUMBER;
  double value = 0;
};

// Sign, digits, point and exponent of a decimal number, taken apart.
struct Decimal
{
  bool valid = false;
  bool negative = false;
  std::uint64_t mantissa = 0;
  int exponent = 0;
  bool exact = true;  // the mantissa holds every digit
};

Decimal takeApart(const Words& word)
{
  constexpr std::uint64_t MANTISSA_ROOM = 100000000000000000;  // one more digit always fits
  constexpr int EXPONENT_ROOM = 100000;
  Decimal number;
  const char* c = word.begin;
  if (c != word.end && (*c == '-' || *c == '+'))
  {
    number.negative = *c++ == '-';
  }
  bool after_point = false;
  for (; c != word.end && (isDigit(*c) || (*c == '.' && !after_point)); ++c)
  {
    if (*c == '.')
    {
      after_point = true;
      continue;
    }
    number.valid = true;
    if (number.mantissa < MANTISSA_ROOM)
    {
      number.mantissa = 10 * number.mantissa + static_cast<std::uint64_t>(*c - '0');
      number.exponent -= after_point ? 1 : 0;
    }
    else
    {
      number.exact = false;
    }
  }
  if (number.valid && c != word.end && (*c == 'e' || *c == 'E'))
  {
    ++c;
    const bool negative = c != word.end && *c == '-';
    c += c != word.end && (*c == '-' || *c == '+') ? 1 : 0;
    number.valid = c != word.end;
    int exponent = 0;
    for (; c != word.end && isDigit(*c); ++c)
    {
      exponent = std::min(10 * exponent + (*c - '0'), EXPONENT_ROOM);
    }
    number.exponent += negative ? -exponent : exponent;
  }
  number.valid = number.valid && c == word.end;
  return number;
}

bool isNamedNotFinite(const Words& word)
{
  std::string name;
  for (const char* c = word.begin; c != word.end && name.size() < 16; ++c)
  {
    if (std::strchr("+-.#", *c) == nullptr && !isDigit(*c))
    {
      name += static_cast<char>(*c >= 'A' && *c <= 'Z' ? *c - 'A' + 'a' : *c);
    }
  }
  return name == "nan" || name == "nan(ind)" || name == "inf" || name == "infinity" ||
         name == "ind" || name == "qnan" || name == "snan";
}

// The nearest double, like strtod in the C locale.
Number parseNumber(const Words& word)
{
  static constexpr double POWERS[] = { 1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                       1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                       1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22 };
  constexpr std::uint64_t EXACT_MANTISSA = std::uint64_t{ 1 } << 53;
  const Decimal decimal = takeApart(word);
  if (!decimal.valid)
  {
    return { isNamedNotFinite(word) ? NumberKind::NOT_FINITE : NumberKind::NOT_A_NUMBER, 0 };
  }
  double value = 0;
  if (decimal.exact && decimal.mantissa <= EXACT_MANTISSA && std::abs(decimal.exponent) <= 22)
  {
    // Both are exact doubles, so one operation rounds correctly.
    const double mantissa = static_cast<double>(decimal.mantissa);
    value = decimal.exponent < 0 ? mantissa / POWERS[-decimal.exponent]
                                 : mantissa * POWERS[decimal.exponent];
    value = decimal.negative ? -value : value;
  }
  else
  {
    std::istringstream stream(std::string(word.begin, word.end));
    stream.imbue(std::locale::classic());
    stream >> value;
    if (stream.fail() || !std::isfinite(value))
    {
      return { NumberKind::NOT_FINITE, 0 };
    }
  }
  return { NumberKind::FINITE, value };
}

// An index as it stands in the file. 0 is never right and stands for "left out".
struct Index
{
  bool valid = true;
  long long value = 0;
};

Index parseIndex(const char* begin, const char* end)
{
  constexpr long long ROOM = 1000000000000;
  Index index;
  const bool negative = begin != end && *begin == '-';
  begin += begin != end && (*begin == '-' || *begin == '+') ? 1 : 0;
  index.valid = begin != end;
  for (; begin != end && index.valid; ++begin)
  {
    index.valid = isDigit(*begin);
    index.value = std::min(10 * index.value + (*begin - '0'), ROOM);
  }
  index.value = negative ? -index.value : index.value;
  return index;
}

class Parser
{
public:
  Parser(const std::string& text, const std::string& name, const ImportOptions& options)
      : lines_(text), options_(options), problems_(name)
  {
  }

  ObjContent parse()
  {
    Words line = { nullptr, nullptr };
    while (lines_.read(line))
    {
      line.end = commentIn(line);
      const Words keyword = nextWord(line);
      if (!keyword.empty())
      {
        readStatement(keyword, line);
      }
    }
    checkRanges();
    problems_.refuseIfAny();
    if (content_.faces.empty())
    {
      problems_.refuse(0, "there is no face in it");
    }
    listIgnored();
    return std::move(content_);
  }

private:
  void readStatement(const Words& keyword, Words rest)
  {
    if (keyword.is("v"))
    {
      readVertex(rest);
    }
    else if (keyword.is("vt"))
    {
      readTexture(rest);
    }
    else if (keyword.is("f"))
    {
      readFace(rest);
    }
    else if (keyword.is("vn"))
    {
      ++normals_;
    }
    else if (!keyword.is("o") && !keyword.is("g") && !keyword.is("s"))
    {
      noteIgnored(keyword);
    }
  }

  void problem(const std::string& reason) { problems_.add(lines_.number(), reason); }

  // Up to `most` numbers; says what is wrong with them and returns -1, or how many there were.
  int readNumbers(const char* keyword, Words rest, int least, int most, double* values, int used)
  {
    int count = 0;
    for (Words word = nextWord(rest); !word.empty(); word = nextWord(rest), ++count)
    {
      const Number number = parseNumber(word);
      if (number.kind == NumberKind::NOT_A_NUMBER)
      {
        problem(quoted(word) + " is not a number");
        return -1;
      }
      if (count < used)
      {
        if (number.kind == NumberKind::NOT_FINITE)
        {
          problem(quoted(word) + " is not a finite number");
          return -1;
        }
        values[count] = number.value;
      }
    }
    if (count < least || count > most)
    {
      problem(std::string(keyword) + " has " + std::to_string(count) + " numbers, must have " +
              std::to_string(least) + " to " + std::to_string(most));
      return -1;
    }
    return count;
  }

  // Three coordinates, perhaps a weight, perhaps a colour.
  void readVertex(const Words& rest)
  {
    double xyz[3] = { 0, 0, 0 };
    readNumbers("v", rest, 3, 8, xyz, 3);
    refuseBeyond(content_.positions.size(), options_.max_vertices, "vertices", "max_vertices");
    content_.positions.emplace_back(xyz[0], xyz[1], xyz[2]);
    content_.lines.push_back(lines_.number());
  }

  // u, v = 0 if it is missing, and a depth that no one uses.
  void readTexture(const Words& rest)
  {
    double uv[2] = { 0, 0 };
    readNumbers("vt", rest, 1, 3, uv, 2);
    const double largest = std::max(std::abs(uv[0]), std::abs(uv[1]));
    if (largest > options_.max_texture_coordinate)
    {
      problem("a texture coordinate of " + text(largest) + ", must be at most " +
              text(options_.max_texture_coordinate));
    }
    refuseBeyond(content_.uvs.size(), options_.max_vertices, "texture vertices", "max_vertices");
    content_.uvs.emplace_back(uv[0], uv[1]);
  }

  void refuseBeyond(std::size_t count, int most, const std::string& what, const std::string& limit)
  {
    if (count >= static_cast<std::size_t>(most))
    {
      problems_.refuse(lines_.number(), "there are more than " + std::to_string(most) + " " + what +
                                            " (" + limit + ")");
    }
  }

  void readFace(Words rest)
  {
    ObjFace face;
    face.line = lines_.number();
    face.first_corner = static_cast<int>(content_.corners.size());
    int textured = 0;
    for (Words word = nextWord(rest); !word.empty(); word = nextWord(rest))
    {
      if (face.corner_count == options_.max_polygon_corners)
      {
        problem("the face has more than " + std::to_string(options_.max_polygon_corners) +
                " corners (max_polygon_corners)");
        return;
      }
      ObjCorner corner;
      if (!readCorner(word, corner))
      {
        return;
      }
      content_.corners.push_back(corner);
      ++face.corner_count;
      textured += corner.texture >= 0 ? 1 : 0;
    }
    if (face.corner_count < 3)
    {
      problem("the face has " + std::to_string(face.corner_count) +
              " corners, must have 3 or more");
      return;
    }
    if (textured != 0 && textured != face.corner_count)
    {
      problem("some corners of the face have a texture index and others have none");
      return;
    }
    face.textured = textured != 0;
    triangles_ += face.corner_count - 2;
    if (triangles_ > options_.max_triangles)
    {
      problems_.refuse(lines_.number(), "there are more than " +
                                            std::to_string(options_.max_triangles) +
                                            " triangles (max_triangles)");
    }
    content_.faces.push_back(face);
  }

  // v, v/vt, v//vn or v/vt/vn.
  bool readCorner(const Words& word, ObjCorner& corner)
  {
    Index parts[3];
    const char* begin = word.begin;
    for (int part = 0; part < 3; ++part)
    {
      const char* end = std::find(begin, word.end, '/');
      const bool left_out = begin == end && part > 0;
      parts[part] = left_out ? Index{} : parseIndex(begin, end);
      if (!parts[part].valid)
      {
        break;
      }
      if (!left_out && parts[part].value == 0)
      {
        problem("index 0 in " + quoted(word) + ", they count from 1");
        return false;
      }
      begin = end == word.end ? end : end + 1;
      if (end == word.end)
      {
        break;
      }
    }
    if (begin != word.end || !parts[0].valid || !parts[1].valid || !parts[2].valid)
    {
      problem(quoted(word) + " is not a corner: v, v/vt, v//vn or v/vt/vn");
      return false;
    }
    return resolve("vertex", parts[0].value, content_.positions.size(), corner.vertex) &&
           resolve("texture", parts[1].value, content_.uvs.size(), corner.texture) &&
           resolveNormal(parts[2].value);
  }

  // Negative indices count back from the last line read; positive ones are checked in the end.
  bool resolve(const std::string& kind, long long index, std::size_t so_far, int& resolved)
  {
    if (index < 0 && -index > static_cast<long long>(so_far))
    {
      problem(kind + " index " + std::to_string(index) + " is out of range, there are " +
              std::to_string(so_far) + " before this line");
      return false;
    }
    const long long from_zero = index < 0 ? static_cast<long long>(so_far) + index : index - 1;
    resolved =
        static_cast<int>(std::min<long long>(from_zero, std::numeric_limits<int>::max() - 1));
    return true;
  }

  bool resolveNormal(long long index)
  {
    int resolved = -1;
    if (!resolve("normal", index, normals_, resolved))
    {
      return false;
    }
    if (resolved > highest_normal_)
    {
      highest_normal_ = resolved;
      highest_normal_line_ = lines_.number();
    }
    return true;
  }

  void checkRanges()
  {
    for (const ObjFace& face : content_.faces)
    {
      for (int i = face.first_corner; i < face.first_corner + face.corner_count; ++i)
      {
        checkRange(face.line, "vertex", content_.corners[i].vertex, content_.positions.size());
        checkRange(face.line, "texture", content_.corners[i].texture, content_.uvs.size());
      }
    }
    checkRange(highest_normal_line_, "normal", highest_normal_, normals_);
  }

  void checkRange(int line, const std::string& kind, int index, std::size_t count)
  {
    if (index >= 0 && static_cast<std::size_t>(index) >= count)
    {
      problems_.add(line, kind + " index " + std::to_string(index + 1LL) +
                              " is out of range, there are " + std::to_string(count));
    }
  }

  struct Ignored
  {
    int first_line = 0;
    int count = 0;
  };

  void noteIgnored(const Words& keyword)
  {
    constexpr std::size_t MAX_KEYWORDS = 20;
    const std::string key = quoted(keyword);
    if (ignored_.size() < MAX_KEYWORDS || ignored_.count(key) > 0)
    {
      Ignored& entry = ignored_[key];
      entry.first_line = entry.count == 0 ? lines_.number() : entry.first_line;
      ++entry.count;
    }
  }

  void listIgnored()
  {
    for (const auto& [keyword, entry] : ignored_)
    {
      const std::string times =
          entry.count == 1 ? "" : ", like " + std::to_string(entry.count - 1) + " more";
      content_.ignored.push_back({ entry.first_line, keyword + " is ignored" + times });
    }
  }

  LineReader lines_;
  const ImportOptions& options_;
  ImportProblems problems_;
  ObjContent content_;
  std::size_t normals_ = 0;
  int highest_normal_ = -1;
  int highest_normal_line_ = 0;
  long long triangles_ = 0;
  std::map<std::string, Ignored> ignored_;
};

}  // namespace

ObjContent parseObj(const std::string& text, const std::string& name, const ImportOptions& options)
{
  return Parser(text, name, options).parse();
}

}  // namespace cloth
