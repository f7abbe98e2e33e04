#!/usr/bin/env bash
# program_test.sh FORCESHADE-STUDY: the programs of examples/, a lab's own, with a protocol of two trials of one bump.
. "$(dirname "$0")/../../../../tests/apps/expect.sh"
programs=$(dirname "$forceshade")
printf '%s\n' 'experiment = "classification"' 'name = "Mine"' "language = \"$examples/english.toml\"" 'width_mil = 1000' \
  'stiffness_N_per_mm = 0.5' 'resume = "trial"' 'stimuli = [{ law = "bump-1p" }]' 'radii_mil = [600]' 'repetitions = 2' > mine.toml
mkdir none
# Refused without certificates, which are made then.
expect 1 'refused: no certificate of this build covers bump-1p, 600 mil' -- "$programs/study_session" mine.toml none simulated:premium-1.5 P01
[ ! -e P01 ] || { echo "FAILED: a session that was refused left a folder"; exit 1; }
expect 0 "" -- "$programs/study_prepare" mine.toml certificates
answers() { yes 2 | sed 'n;s/.*//' | "$programs/study_session" $1 certificates simulated:premium-1.5 $2; }
expect 0 "every trial is done" -- answers mine.toml P01
expect 0 "whole" -- "$forceshade" experiment verify P01
expect 0 " 0 differ" -- "$forceshade" experiment recompute P01
# The same bump as a subject with damping, which needs no other certificate.
printf 'law = "bump-1p"\n[damping]\ndrag = 0.001\ntime = "2ms"\n' > oil.toml
sed -e 's/^stimuli.*/stimuli = [{ name = "oil", subject = "oil.toml" }]/' -e '/^radii/d' mine.toml > oiled.toml
expect 0 "every trial is done" -- answers oiled.toml P02
expect 0 " 0 differ" -- "$forceshade" experiment recompute P02
same 0.001 "$(python3 -c 'import glob, sqlite3
file = sqlite3.connect(sorted(glob.glob("P02/ticks/run-1/*.fsr"))[0])
print(*file.execute("SELECT value FROM metadata WHERE key = \"damping_drag_N_s_per_mm\"").fetchone())')"
# A program that drives a device has nothing of the exact side.
! nm -C "$programs/study_session" | grep -E 'CGAL::|rc::|forceshade::reference' || { echo "FAILED: it holds exact code"; exit 1; }
echo "$checks checks passed"
