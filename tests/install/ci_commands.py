#!/usr/bin/env python3
"""ci_commands.py FILE.yml: prints the commands that a workflow of GitHub or a configuration of GitLab runs, as one script."""

import sys

import yaml


def commands_of_github(job):
    assert all(("run" in step) != ("uses" in step) for step in job["steps"]), "a step neither runs nor uses, or does both"
    return [step["run"] for step in job["steps"] if "run" in step]


def commands_of_gitlab(job):
    return job["before_script"] + job["script"]


def main():
    with open(sys.argv[1]) as file:
        contents = yaml.safe_load(file)
    if "jobs" in contents:
        assert True in contents, "the workflow has no key on"  # which YAML 1.1 reads as a truth value
        commands = commands_of_github(contents["jobs"]["conform"])
    else:
        commands = commands_of_gitlab(contents["conform"])
    assert len(commands) >= 4 and all(isinstance(command, str) for command in commands), commands
    print("\n".join(command.rstrip("\n") for command in commands))


main()
