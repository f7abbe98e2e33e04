#!/usr/bin/env bash
# simulator_test.sh FORCESHADE: simulators through the door of processes: an exact one, the same one wrong in one thing, and such that
# do not keep to the protocol.
. "$(dirname "$0")/expect.sh"
exact=$(realpath "$(dirname "$0")/exact_simulator.py")
conform() { "$forceshade" conform --answer-timeout 20 "$@"; }

expect 0 "an exact simulator 1, a simulator: it has none" -- conform --simulator "$exact" --json found.json --junit found.xml
same "0 true 23" "$(grep -c '"held": false' found.json) $(sed -n 's/^  "held": \(.*\),/\1/p' found.json) $(grep -c '<testcase' found.xml)"

# Wrong in one thing. wrong ORIGINAL REPLACEMENT INVARIANTS: these fail, and no others.
wrong() {
  changed "$exact" "$1" "$2"
  expect 1 "" -- conform --simulator "python3 mutated.py" --json found.json --overwrite
  same "$(sort <<< "$3")" "$(python3 -c 'import json; [print(i["name"]) for i in json.load(open("found.json"))["invariants"] if not i.get("held", True)]' | sort)"
}
speed="a flat floor keeps the speed, however it is triangulated"
load="a flat floor pushes with what lies on it, however it is triangulated"
ghost="a flat floor has no ghost forces at inner edges"
normals="the normals that are reported on a flat floor are its own"
touching="a sphere that touches exactly is pushed along the normal"
rest="a sphere at rest stays at rest"
static="the static force is the same at any rate"
report="what is reported agrees with the motion"
air="there is no force out of contact"
pull="the ground never pulls"
sunk="nothing sinks into the ground or passes through it"
energy="there is no energy out of nothing"
units="millimetres and metres give the same motion"
turn="a quarter turn of the scene turns the motion"
mirror="a mirrored scene gives the mirrored motion"
numbers="other numbers of triangles and vertices change nothing"
twice="the same run twice gives the same bits"
fresh="a reset equals a fresh start"
no_number="after a force that is no number and a reset, all is as before"
huge="1e30 N move the sphere by as much, or are refused"
vertex="a vertex that is no number, 0.9 m away, leaves the floor where it is"
triangle="a degenerate triangle, 0.9 m away, leaves the floor where it is"


# A line of the step, and lines that come after it.
free="        free = add(add(self.velocity, self.scene[\"gravity\"], dt), applied, dt / mass)"
step="        self.velocity = add(free, pushed, 1 / dt)"
after_step() { wrong "$step" "$step
        $1" "$2"; }

# What a hand would feel of a floor.
after_step "if length > 0 and isinstance(self.ground, Plane) and any((a / units + 0.075) // 0.15 != (b / units + 0.075) // 0.15
                              for a, b in zip(self.position[:2], add(position, free, -dt))):
            self.velocity = [0.95 * x for x in self.velocity]  # ghost forces at lines between cells" "$speed
$ghost
$report
$huge"
wrong "range(20)" "range(20 * self.__dict__.setdefault('turns', [1, 0] * 10000).pop())" "$load
$rest
$static"
wrong "[x / length for x in pushed]" "[x / length + 0.03 * (axis == 0) for axis, x in enumerate(pushed)]" "$normals
$touching
$report"

# What it reports, and its time.
wrong "[mass * length / (dt * dt)]" "[mass * length / dt]" "$static
$report"
wrong "[mass * length / (dt * dt)]" "[mass * length / (dt / 240)]" "$static"

# The ground, and the air.
wrong "        for _ in range(20):" "        if self.ground.push(self.position, sphere[\"radius\"] + 1e-4 * units):
            free = add(free, [0, 0, -max(0, free[2])])  # it sticks
            position = add(self.position, free, dt)
        for _ in range(20):" "$pull
$report"
after_step "if length > 0 and max(map(abs, self.velocity)) < 1e-3 * units: self.position[0] += 4e-6 * units  # creeps" "$rest"
wrong "if depth > 0 else None" "if 0 < depth < 0.06 * radius else None" "$sunk"
wrong "$step" "        self.velocity = add(free, pushed, (2.1 if free[2] < -1.5 * units else 1) / dt)" "$energy
$report"
after_step "if length == 0: self.velocity = [0.995 * x for x in self.velocity]  # resistance of the air" "$air
$pull
$report"

# Other scenes.
wrong "$free" "$free
        free = [max(-400, min(400, x)) for x in free]  # a cap in units of the scene" "$units
$huge"
after_step "if self.velocity[1] > 0.7 * units: self.position[1] += 1e-5 * units" "$turn"
after_step "if self.velocity[1] < -0.1 * units: self.position[1] += 1e-5 * units" "$mirror"
after_step "if self.scene[\"ground\"].get(\"triangles\", [[0]])[0][0] > 0: self.position[0] += 1e-5 * units" "$numbers"

# What is left over, and what is no number.
wrong "self.velocity = list(sphere[\"position\"]), list(sphere[\"velocity\"])" \
  "self.velocity = list(sphere[\"position\"]), getattr(self, 'velocity', list(sphere[\"velocity\"]))" "$fresh
$huge"
wrong "$step" "        import random
        self.velocity = add(free, pushed, (1 + 1e-13 * random.random()) / dt)" "$twice
$fresh"
wrong 'answer = {"accepts": False, "reason": "a force is no number"}' \
  'answer = {"motion": [{"position": [None] * 3, "velocity": [0] * 3, "contacts": []}] * len(asked["applied"])}' "$no_number"
wrong 'raise ValueError("a vertex is no number")' 'return Plane([0, 0, 1], -1e9)' "$vertex"
wrong "            continue" "            return Plane([0, 0, 1], -1e9)" "$triangle"

# What it declares is demanded, and no more.
has() {
  changed "$exact" "$1" "$2"
  expect 0 "$3" -- conform --simulator "python3 mutated.py"
}
has '"reports": "force"' '"reports": "nothing"' "not applicable: $report: it reports no contacts"
has '"smallest_radius_m": 0' '"smallest_radius_m": 0.05' "not applicable to 11 cases, since its smallest radius is 0.05 m"
refuses() {
  changed "$exact" "$1" "$2"
  expect 1 "$3" -- conform --simulator "python3 mutated.py"
}
refuses '"kind": "simulator", ' "" 'the simulator'"'"'s hello has no key "kind"; expected "simulator"'
refuses '"hard"' '"firm"' 'has constraint "firm"; expected "hard", "soft" or "penalty"'
refuses '"binary": 64' '"binary": 80' 'has binary 80; expected 32 or 64'
refuses '"speed_cap_m_per_s": None' '"speed_cap_m_per_s": -1' 'has speed_cap_m_per_s -1; expected'
refuses 'answer = dict(about)' 'answer = about | {"accepts": False, "reason": "no licence"}' "not applicable: $speed: no licence"

# Answers of the wrong shape.
refuses '"position": self.position, ' "" 'position of step 0 is null; expected a list of three numbers'
refuses '"position": self.position' '"position": [*self.position, 0]' "expected a list of three numbers"
refuses '"velocity": self.velocity' '"velocity": "fast"' 'velocity of step 0 is "fast"; expected a list of three numbers'
refuses '"contacts": contacts' '"contacts": [[0, 0, 1]]' "expected a list of four numbers"
refuses '"contacts": contacts' '"contacts": {}' "expected a list of contacts"
refuses 'for force in asked["applied"]]}' 'for force in asked["applied"][1:]]}' 'answered 240 forces with 239 entries of "motion"'
refuses '{"motion": [world' '{"moved": [world' 'answered without a list "motion"'
refuses '"position": self.position' '"position": [None] * 3' 'FAILED: every answer is a finite number'
refuses "            return  # goodbye" "            sys.exit(5)" "the simulator ended with exit code 5"
expect 1 "the simulator ended without an answer" -- conform --simulator true
expect 1 "the simulator did not answer within 0.3 s" -- "$forceshade" conform --simulator "sleep 100" --answer-timeout 0.3
expect 1 "expected a JSON object in one line" -- conform --simulator "echo 1e999; cat"
expect 2 "--command or --simulator" -- conform
expect 2 "--simulator" -- conform --command true --simulator true
expect 2 "--simulator" -- conform --law wall --simulator true
