"""classification-flow.svg: the path of a start from its integration to its outcome, as in classification.md. Nothing is computed."""

from drawn_page import DARK, INK, PALE, QUIET, Page

W, H = 860, 640
page = Page(W, H, "How a start is classified")
ASK, YES = 40, 560  # left edges: questions, outcomes
WIDE, FATE = 400, 262


def step(y, words, high=44, x=ASK, wide=WIDE, fill=PALE):
    page.box(x, y, wide, high, fill=fill, stroke=QUIET, corner=8)
    lines = words.count("\n") + 1
    page.text(x + wide / 2, y + high / 2 - 9 * (lines - 1) + 5, words, 14, INK, "middle")


def ask(y, words, fate, ground, high=58):
    """A question; `yes` leads to an outcome on the right."""
    step(y, words, high, fill="#dcebf5")
    middle = y + high / 2
    page.line([(ASK + WIDE, middle), (YES, middle)], INK, 1.4, arrow=True)
    page.text(ASK + WIDE + 12, middle - 7, "yes", 14)
    page.box(YES, y, FATE, high, fill="#d5efe5", stroke=DARK["balanced"], corner=8)
    page.text(YES + FATE / 2, y + high / 2 - 4, fate, 14, INK, "middle", bold=True)
    page.text(YES + FATE / 2, y + high / 2 + 16, f"ground: {ground}", 13, QUIET, "middle")


def down(y0, y1, words=""):
    x = ASK + WIDE / 2
    page.line([(x, y0), (x, y1)], INK, 1.4, arrow=True)
    if words:
        page.text(x + 10, (y0 + y1) / 2 + 5, words, 14)


step(18, "integrate one step", 40)
down(58, 88)
ask(88, "after the step:\ninside a level set of balance or an orbit’s tube?", "that attractor", "validated or proof")
down(146, 176, "no")
ask(176, "after half a short window:\nin a region of rest or another orbit?", "that attractor", "validated")
down(234, 264, "no")
ask(264, "enough short windows in a row\nin one motion’s box?", "that attractor", "windows")
down(322, 352, "no")
ask(352, "at the end of a long window:\nhave two in a row repeated the one before?", "that attractor, if listed", "windows")
down(410, 440, "no")
ask(440, "horizon reached?", "undecided", "none")

# Stationary but not listed.
page.line([(YES + FATE, 381), (YES + FATE + 20, 381), (YES + FATE + 20, 583), (YES + FATE, 583)], INK, 1.4, arrow=True)
page.text(YES + FATE + 14, 530, "if not", 14, INK, "end")
page.box(YES, 548, FATE, 70, fill="#d5efe5", stroke=DARK["balanced"], corner=8)
page.text(YES + FATE / 2, 572, "followed to its motion,", 14, INK, "middle", bold=True)
page.text(YES + FATE / 2, 590, "which is then listed", 14, INK, "middle", bold=True)
page.text(YES + FATE / 2, 608, "ground: followed", 13, QUIET, "middle")
# Back to the next step.
page.line([(ASK + WIDE / 2, 498), (ASK + WIDE / 2, 524), (18, 524), (18, 38), (ASK, 38)], INK, 1.4, arrow=True)
page.text(ASK + WIDE / 2 + 10, 518, "no: next step", 14)
page.text(ASK, 566, "Beside this, a state variable beyond 10⁶ makes a start\ndiverged and a vanishing step makes it failed.", 14, QUIET)
page.write(__file__)
