(* SPDX-License-Identifier: BSD-3-Clause *)
(* Reads what code_rows.cpp reads, and prints what the definitions of proofs/ answer, stage by stage (proofs/code/Model.v). *)

let hex text = Z.of_string ("0x" ^ text)
let shown = Z.format "%x"
let is_nan bits = Z.gt (Z.logand bits (hex "7fffffffffffffff")) (hex "7ff0000000000000")
let shown64 bits = if is_nan bits then "nan" else shown bits
let flag value = if value then "1" else "0"

let words (status, ((x, y), z)) =
  assert (Z.equal y Z.zero);
  let name = match status with Model.Free -> "free" | Model.Contact -> "contact" | Model.Invalid -> "invalid" in
  Printf.sprintf "%s %s %s" name (shown x) (shown z)

let row law x y z =
  let answer = Model.answer_of law x y z and ((fx, fz), contact), doubt = Model.first_of law x z in
  let shown_later each = if words each = words answer then "=" else words each in
  let later =
    match if fst answer = Model.Invalid then None else Model.later_of_bits law x z with
    | None -> "- | -"
    | Some (second, third) -> (match second with None -> "undecided" | Some each -> shown_later each) ^ " | " ^ shown_later third
  in
  Printf.sprintf "%s | %s %s %s %s | %s" (words answer) (shown64 fx) (shown64 fz) (flag contact) (flag doubt) later

let () =
  let law = ref None in
  try
    while true do
      let line = input_line stdin in
      match String.split_on_char ' ' line with
      | "law" :: name :: radius :: width :: stiffness :: _ ->
          (match Model.law_of_bits name (hex radius) (hex width) (hex stiffness) with
          | None -> failwith ("expected the name of a law, got " ^ name)
          | Some each ->
              law := Some each;
              let members = String.concat "" (List.map (fun bits -> " " ^ shown bits) (Model.members_bits each)) in
              Printf.printf "law %s %s %s %s =%s\n" name radius width stiffness members)
      | x :: y :: z :: _ when line.[0] <> '#' -> (
          match !law with
          | Some law -> Printf.printf "%s %s %s = %s\n" x y z (row law (hex x) (hex y) (hex z))
          | None -> failwith "expected a law before the first position")
      | _ -> ()
    done
  with End_of_file -> ()
