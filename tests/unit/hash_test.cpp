// SPDX-License-Identifier: MIT
#include "plumb/base/hash.h"
#include "support/catch.h"
#include "support/temp_directory.h"

using namespace plumb;

namespace {

std::string hash(std::string_view bytes)
{
    Hash128 result;
    result.update(bytes);
    return result.hex();
}

} // namespace

TEST_CASE("hash: published values of MurmurHash3_x64_128 with seed 0", "[unit][hash]")
{
    CHECK(hash("") == "00000000000000000000000000000000");
    CHECK(hash("hello") == "cbd8a7b341bd9b025b1e906a48ae1d19");
    CHECK(hash("hello, world") == "342fac623a5ebc8e4cdcbc079642414d");
    CHECK(hash("19 Jan 2038 at 3:14:07 AM") == "b89e5988b737affc664fc2950231b2cb");
    CHECK(hash("The quick brown fox jumps over the lazy dog.") == "cd99481f9ee902c9695da1a38987b6e7");
}

TEST_CASE("hash: SHA-256 of FIPS 180-4's examples, and of files", "[unit][hash]")
{
    CHECK(sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    CHECK(sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    CHECK(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
          "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    const std::string million(1000000, 'a');
    const std::string expected = "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0";
    CHECK(sha256(million) == expected);
    const TempDirectory directory;
    CHECK(sha256_of_file(directory.write("a", million)) == expected);
    CHECK(sha256_of_file(directory.write("b", "abc")) == sha256("abc"));
    CHECK(sha256_of_file(directory / "none").empty());
}

TEST_CASE("hash: pieces hash like the whole", "[unit][hash]")
{
    std::string text;
    for (int i = 0; i < 100; ++i) text += static_cast<char>(i * 37);
    const std::size_t cut = GENERATE(range(0, 100));
    Hash128 pieces;
    pieces.update(std::string_view(text).substr(0, cut));
    CHECK(pieces.hex() == hash(std::string_view(text).substr(0, cut)));
    pieces.update(std::string_view(text).substr(cut, 5));
    pieces.update(std::string_view(text).substr(std::min<std::size_t>(cut + 5, text.size())));
    CHECK(pieces.hex() == hash(text));
    CHECK(hash(text) != hash(text + '\0'));
}
