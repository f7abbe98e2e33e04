// SPDX-License-Identifier: BSD-3-Clause
// node bids_validators.mjs FOLDER DATASET legacy-warning=CODE…: the two validators of the npm package bids-validator 1.15.0, which is
// installed in FOLDER, on a data set. Exit code 1, and a line for each fault, where one of them finds an error, or where the legacy one
// warns of more than these codes.
import { spawnSync } from 'node:child_process'
import { readdirSync, readFileSync } from 'node:fs'
import { join, sep } from 'node:path'

const [, , packages, dataset, ...rest] = process.argv
const allowed = rest.map((word) => Number(word.replace('legacy-warning=', '')))
const validator = join(packages, 'node_modules', 'bids-validator')
const faults = []

// The legacy validator reads the folder itself. It takes the first row of a motion file, which has no header line, for column names
// (warning 82), so this code counts as allowed for motion files alone.
const legacy = spawnSync(process.execPath, [join(validator, 'bin', 'bids-validator'), dataset, '--json'],
  { encoding: 'utf8', maxBuffer: 1 << 28 })
const { errors, warnings } = JSON.parse(legacy.stdout).issues
for (const issue of [...errors, ...warnings]) {
  const files = issue.files.map((one) => one.file?.relativePath ?? '').filter((path) => issue.code !== 82 || !path.endsWith('_motion.tsv'))
  if (issue.severity === 'warning' && (allowed.includes(issue.code) || (issue.code === 82 && files.length === 0))) continue
  for (const { file, evidence } of issue.files)
    faults.push(`legacy ${issue.severity} ${issue.code} ${issue.key}: ${file?.relativePath ?? ''} ${evidence ?? ''}`)
}

// The schema validator does not know files without a header line, either, and refuses the first row where two of its numbers are equal.
// It gets each motion file below a line of its channels' names, so that it judges all else of it.
const { validate, fileListToTree } = await import(join(validator, 'dist', 'validator', 'main.js'))
const files = readdirSync(dataset, { recursive: true, withFileTypes: true }).filter((entry) => entry.isFile()).map((entry) => {
  const path = join(entry.parentPath ?? entry.path, entry.name)
  const content = [readFileSync(path)]
  if (path.endsWith('_motion.tsv')) {
    const channels = readFileSync(path.replace(/_motion\.tsv$/, '_channels.tsv'), 'utf8').trimEnd().split('\n').slice(1)
    content.unshift(channels.map((row) => row.split('\t')[0]).join('\t') + '\n')
  }
  const file = new File(content, entry.name)
  Object.defineProperty(file, 'webkitRelativePath', { value: join('dataset', path.slice(join(dataset, sep).length)) })
  return file
})
const { issues } = await validate(await fileListToTree(files), { datasetPath: dataset, datasetTypes: [], blacklistModalities: [] })
for (const issue of issues.issues)
  if (issue.severity === 'error')
    faults.push(`schema error ${issue.code} ${issue.subCode ?? ''}: ${issue.location ?? ''} ${issue.issueMessage ?? ''}`)

for (const fault of faults) console.log(fault)
console.log(`${files.length} files, ${faults.length} faults; legacy warnings ${warnings.map((issue) => issue.code).join(' ') || 'none'}`)
process.exit(faults.length === 0 ? 0 : 1)
