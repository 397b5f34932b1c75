"""The word test is itself tested: it refuses the old sentences, wherever they are written, and lets their plain form pass."""

import tempfile
import unittest
from pathlib import Path

from words import EXCEPTIONS, problems, unused_exceptions, words_of

# (old sentence, the words that are refused in it, its plain form)
SENTENCES = [
    ("whoever listens at the port did not answer, and was let go", {"whoever", "let go"},
     "ParaView did not respond within 30 s; the connection was closed"),
    ("whatever the steps to come bring, that costs at most twice what the best moment would have", {"whatever"},
     "rebalance when accumulated waiting exceeds the cost of a rebalance: at most twice the optimal cost"),
    ("Stage {} has {}, other than the stage before it: nothing is taken over", {"taken over"},
     "stage {} lacks the {} of the previous stage; stages do not inherit, repeat the entry"),
    ("a side far away that it looks at but has not come through", {"looks"},
     "no force starts if the nearest facing surface is deeper than kFarSide"),
    ("what the couple held is gone; where it has left over an edge, all but ...", {"held", "gone"},
     "the stored energy is dissipated; if the point left across an edge, the same less ..."),
    ("`breccia check` tells what it says of a step that is late", {"tells", "says", "late"},
     "`breccia check` reports a delayed step"),
    ("nobody booked it in the ledger of the Teller", {"nobody", "booked", "ledger", "teller"},
     "an unaccounted term of the energy budget"),
    ("calm joints settle and the run goes on", {"calm", "settle", "goes on"},
     "elastic joints come to rest and the run continues"),
    ("strangers asked, the others heard and judged", {"strangers", "asked", "heard", "judged"},
     "remote viewers send requests, which are checked"),
]


def refused(file, source):
    return {word for _, _, word, _ in words_of(file, source)}


class Words(unittest.TestCase):
    def test_old_sentences_are_refused_in_messages_and_headers_and_their_plain_forms_are_not(self):
        for old, words, plain in SENTENCES:
            with self.subTest(old=old):
                self.assertEqual(refused("solver/a.cpp", f'const char* text = "{old}";\n'), words)
                self.assertEqual(refused("gui/a.hpp", f"/// {old}\n"), words)
                self.assertEqual(refused("catalyst/a.py", f'"""{old}"""\n'), words)
                self.assertEqual(refused("solver/a.md", f"Text. {old.replace('`', '')}\n"), words - {"settle"})
                self.assertEqual(refused("solver/a.cpp", f'const char* text = "{plain}";\n'), set())
                self.assertEqual(refused("solver/a.hpp", f"/// {plain}\n"), set())

    def test_words_that_go_over_a_line_are_found_on_it(self):
        self.assertEqual(words_of("solver/a.cpp", 'f(1,\n  "a run that goes "\n  "on");\n')[0][:3], ("string", 2, "goes on"))
        self.assertEqual(words_of("solver/a.hpp", "int a;\n/// a link that is let\n/// go\n")[0][:3], ("comment", 2, "let go"))
        self.assertEqual(refused("solver/a.cpp", 'R"(a run\nthat goes\non)"'), {"goes on"})

    def test_code_and_keys_and_comments_of_cpp_files_are_left_alone(self):
        self.assertEqual(refused("solver/a.cpp", "// it is told\nint told = held(look);\n"), set())
        self.assertEqual(refused("solver/a.cpp", 'key("look"); character = \'"\'; key("held");\n'), set())
        self.assertEqual(refused("gui/a.hpp", 'int look = 1; const char* url = "http://told";\n'), set())
        self.assertEqual(refused("catalyst/a.py", "told = {'look': 1}  # asked\n"), set())
        self.assertEqual(refused("a.md", "The key `held` of\n\n```sh\nlook told\n```\n"), set())

    def test_words_that_contain_a_refused_one_are_left_alone(self):
        self.assertEqual(refused("solver/a.hpp", "/// calmar, latest, outlook, threshold, essay, mask, shelled, relate\n"), set())

    def test_a_hit_is_printed_with_its_place_and_what_to_write(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "plugins" / "a.h"
            path.parent.mkdir()
            path.write_text("\n// it is gone\n", encoding="utf-8")
            self.assertEqual(problems(folder), ["plugins/a.h:2: gone: removed, ended, missing"])

    def test_every_exception_has_a_reason_and_one_that_covers_nothing_is_reported(self):
        self.assertTrue(all(len(reason) > 10 for _, _, reason in EXCEPTIONS))
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(len(list(unused_exceptions(folder))), len(EXCEPTIONS))


if __name__ == "__main__":
    unittest.main()
