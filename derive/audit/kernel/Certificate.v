(** Equalities of rational expressions over the reals, decided by computation.

    A certificate says: the numerator of [left - right], expanded over its list of denominators, is the sum of cofactor
    times relation. [certificate] turns that computation into the equality itself, wherever the relations hold and no
    denominator vanishes. Polynomials are those of Coq's own ring tactic ([Ring_polynom]), over the integers. *)

From Coq Require Import Reals ZArith NArith List Bool.
From Coq Require Import Ring_theory Ring_polynom InitialRing BinList RealField Field Field_theory.
Import ListNotations.
Local Open Scope R_scope.

(** Expressions; [Var p] is the p-th entry of a list of values. *)
Inductive term :=
| Var (place : positive)
| Int (number : Z)
| Add (a b : term)
| Mul (a b : term)
| Opp (a : term)
| Inv (a : term).

Fixpoint value (l : list R) (t : term) : R :=
  match t with
  | Var p => BinList.nth 0 p l
  | Int z => IZR z
  | Add a b => value l a + value l b
  | Mul a b => value l a * value l b
  | Opp a => - value l a
  | Inv a => / value l a
  end.

(** Every expression by which [t] divides is other than zero. *)
Fixpoint defined (l : list R) (t : term) : Prop :=
  match t with
  | Var _ | Int _ => True
  | Add a b | Mul a b => defined l a /\ defined l b
  | Opp a => defined l a
  | Inv a => defined l a /\ value l a <> 0
  end.

(** Polynomials over the integers. *)
Notation poly := (Pol Z).
Notation plus := (Padd 0%Z Z.add Zeq_bool).
Notation times := (Pmul 0%Z 1%Z Z.add Z.mul Zeq_bool).
Notation minus := (Popp Z.opp).
Notation same := (Peq Zeq_bool).
Notation at_point := (Pphi 0 Rplus Rmult IZR).
Notation constant := (fun z : Z => Pc z).

Lemma integers :
  ring_morph 0 1 Rplus Rmult Rminus Ropp (@eq R) 0%Z 1%Z Z.add Z.mul Z.sub Z.opp Zeq_bool IZR.
Proof.
  constructor; try reflexivity; intros.
  - apply plus_IZR.
  - apply minus_IZR.
  - apply mult_IZR.
  - apply opp_IZR.
  - f_equal. now apply Zeq_bool_eq.
Qed.

Definition almost : almost_ring_theory 0 1 Rplus Rmult Rminus Ropp (@eq R) :=
  Rth_ARth Rset Rext (F_R Rfield).

Lemma plus_ok l p q : at_point l (plus p q) = at_point l p + at_point l q.
Proof. apply (Padd_ok Rset Rext almost integers). Qed.

Lemma times_ok l p q : at_point l (times p q) = at_point l p * at_point l q.
Proof. apply (Pmul_ok Rset Rext almost integers). Qed.

Lemma minus_ok l p : at_point l (minus p) = - at_point l p.
Proof. apply (Popp_ok Rset Rext almost integers). Qed.

Lemma same_ok l p q : same p q = true -> at_point l p = at_point l q.
Proof. intros. now apply (Peq_ok Rset Rext integers). Qed.

Lemma variable_ok l p : at_point l (mk_X 0%Z 1%Z p) = BinList.nth 0 p l.
Proof. symmetry. apply (mkX_ok Rset Rext almost integers). Qed.

(** Products of lists of factors. *)
Fixpoint product (factors : list poly) : poly :=
  match factors with
  | [] => constant 1%Z
  | factor :: rest => times factor (product rest)
  end.

Fixpoint produced (l : list R) (factors : list poly) : R :=
  match factors with
  | [] => 1
  | factor :: rest => at_point l factor * produced l rest
  end.

Lemma product_ok l factors : at_point l (product factors) = produced l factors.
Proof.
  induction factors as [|factor rest step]; simpl product; simpl produced.
  - reflexivity.
  - now rewrite times_ok, step.
Qed.

Lemma produced_app l first second : produced l (first ++ second) = produced l first * produced l second.
Proof.
  induction first as [|factor rest step]; simpl.
  - now rewrite Rmult_1_l.
  - now rewrite step, Rmult_assoc.
Qed.

(** One factor taken from a list, if it is there. *)
Fixpoint taken (factor : poly) (factors : list poly) : option (list poly) :=
  match factors with
  | [] => None
  | first :: rest =>
      if same factor first then Some rest
      else match taken factor rest with Some fewer => Some (first :: fewer) | None => None end
  end.

Lemma taken_ok l factor factors fewer :
  taken factor factors = Some fewer -> produced l factors = at_point l factor * produced l fewer.
Proof.
  revert fewer. induction factors as [|first rest step]; simpl; intros fewer found; [discriminate|].
  destruct (same factor first) eqn:equal.
  - injection found as <-. now rewrite (same_ok l _ _ equal).
  - destruct (taken factor rest) as [less|]; [|discriminate].
    injection found as <-. simpl. rewrite (step less eq_refl). ring.
Qed.

(** Two lists of factors as what they share and what is left of each. *)
Fixpoint shared (first second : list poly) : list poly * list poly * list poly :=
  match first with
  | [] => ([], [], second)
  | factor :: rest =>
      match taken factor second with
      | Some fewer => let '(common, a, b) := shared rest fewer in (factor :: common, a, b)
      | None => let '(common, a, b) := shared rest second in (common, factor :: a, b)
      end
  end.

Lemma shared_ok l first second common a b :
  shared first second = (common, a, b) ->
  produced l first = produced l common * produced l a /\ produced l second = produced l common * produced l b.
Proof.
  revert second common a b. induction first as [|factor rest step]; simpl; intros second common a b found.
  - injection found as <- <- <-. simpl. split; ring.
  - destruct (taken factor second) as [fewer|] eqn:there.
    + destruct (shared rest fewer) as [[c x] y] eqn:inner. injection found as <- <- <-.
      destruct (step _ _ _ _ inner) as [one two]. rewrite (taken_ok l _ _ _ there), one, two. simpl. split; ring.
    + destruct (shared rest second) as [[c x] y] eqn:inner. injection found as <- <- <-.
      destruct (step _ _ _ _ inner) as [one two]. rewrite one, two. simpl. split; ring.
Qed.

(** Numerator and denominators of an expression; nothing is cancelled. *)
Fixpoint quotient (t : term) : poly * list poly :=
  match t with
  | Var p => (mk_X 0%Z 1%Z p, [])
  | Int z => (constant z, [])
  | Opp a => let (above, below) := quotient a in (minus above, below)
  | Mul a b =>
      let (above, below) := quotient a in
      let (above', below') := quotient b in
      (times above above', below ++ below')
  | Add a b =>
      let (above, below) := quotient a in
      let (above', below') := quotient b in
      let '(common, mine, yours) := shared below below' in
      (plus (times above (product yours)) (times above' (product mine)), common ++ mine ++ yours)
  | Inv a =>
      let (above, below) := quotient a in
      (product below, if same above (constant 1%Z) then [] else [above])
  end.

Lemma quotient_ok l t above below :
  quotient t = (above, below) -> defined l t ->
  produced l below <> 0 /\ value l t = at_point l above / produced l below.
Proof.
  revert above below.
  induction t as [p|z|a first b second|a first b second|a first|a first]; cbn [quotient defined value]; intros above below found there.
  - injection found as <- <-. simpl. split; [exact R1_neq_R0|]. rewrite variable_ok. field.
  - injection found as <- <-. simpl. split; [exact R1_neq_R0|]. field.
  - destruct (quotient a) as [n d], (quotient b) as [n' d'].
    destruct there as [there there'].
    destruct (first _ _ eq_refl there) as [fine equal], (second _ _ eq_refl there') as [fine' equal'].
    destruct (shared d d') as [[common mine] yours] eqn:parts. injection found as <- <-.
    destruct (shared_ok l _ _ _ _ _ parts) as [one two].
    rewrite !produced_app, equal, equal', plus_ok, !times_ok, !product_ok.
    rewrite one in *. rewrite two in *.
    assert (produced l common <> 0 /\ produced l mine <> 0 /\ produced l yours <> 0) as (x & y & z).
    { repeat split; intro zero; rewrite zero in *; (apply fine; ring) || (apply fine'; ring). }
    split.
    + repeat apply Rmult_integral_contrapositive_currified; assumption.
    + field. repeat split; assumption.
  - destruct (quotient a) as [n d], (quotient b) as [n' d'].
    destruct there as [there there'].
    destruct (first _ _ eq_refl there) as [fine equal], (second _ _ eq_refl there') as [fine' equal'].
    injection found as <- <-. rewrite produced_app, equal, equal', times_ok. split.
    + now apply Rmult_integral_contrapositive_currified.
    + field. split; assumption.
  - destruct (quotient a) as [n d]. destruct (first _ _ eq_refl there) as [fine equal].
    injection found as <- <-. rewrite equal, minus_ok. split; [assumption|]. field. assumption.
  - destruct (quotient a) as [n d]. destruct there as [there other].
    destruct (first _ _ eq_refl there) as [fine equal].
    assert (at_point l n <> 0) as top.
    { intro zero. apply other. rewrite equal, zero. field. assumption. }
    destruct (same n (constant 1%Z)) eqn:one; injection found as <- <-; rewrite equal, product_ok; simpl produced.
    + split; [exact R1_neq_R0|]. rewrite (same_ok l _ _ one). simpl. field. assumption.
    + split; [now rewrite Rmult_1_r|]. field. split; assumption.
Qed.

(** Polynomials as they are written in certificates. *)
Notation written := (PExpr Z).
Notation read := (norm_aux 0%Z 1%Z Z.add Z.mul Z.sub Z.opp Zeq_bool).
Notation reading := (PEeval 0 1 Rplus Rmult Rminus Ropp IZR N.to_nat pow).

Lemma read_ok l w : at_point l (read w) = reading l w.
Proof.
  symmetry.
  apply (norm_aux_spec Rset Rext almost integers R_power_theory).
Qed.

(** The sum of cofactor times relation. *)
Fixpoint combined (pairs : list (written * written)) : poly :=
  match pairs with
  | [] => constant 0%Z
  | (cofactor, relation) :: rest => plus (times (read cofactor) (read relation)) (combined rest)
  end.

Fixpoint hold (l : list R) (pairs : list (written * written)) : Prop :=
  match pairs with
  | [] => True
  | (_, relation) :: rest => reading l relation = 0 /\ hold l rest
  end.

Lemma combined_ok l pairs : hold l pairs -> at_point l (combined pairs) = 0.
Proof.
  induction pairs as [|[cofactor relation] rest step]; simpl combined; simpl hold; intros.
  - reflexivity.
  - destruct H as [zero others]. rewrite plus_ok, times_ok, (step others), !read_ok, zero. ring.
Qed.

(** Factors other than zero by which the recorded numerator exceeds the one found here. *)
Fixpoint other (l : list R) (factors : list written) : Prop :=
  match factors with
  | [] => True
  | factor :: rest => reading l factor <> 0 /\ other l rest
  end.

Lemma other_ok l factors : other l factors -> produced l (map (fun w => read w) factors) <> 0.
Proof.
  induction factors as [|factor rest step]; simpl; intros all.
  - exact R1_neq_R0.
  - destruct all as [this others]. apply Rmult_integral_contrapositive_currified; [|now apply step].
    now rewrite read_ok.
Qed.

Definition decides (left right : term) (pairs : list (written * written)) (scale : list written) : bool :=
  same (times (fst (quotient (Add left (Opp right)))) (product (map (fun w => read w) scale))) (combined pairs).

Theorem certificate l left right pairs scale :
  hold l pairs -> other l scale -> defined l left -> defined l right -> decides left right pairs scale = true ->
  value l left = value l right.
Proof.
  intros relations factors one two computed. apply Rminus_diag_uniq.
  change (value l (Add left (Opp right)) = 0).
  destruct (quotient (Add left (Opp right))) as [above below] eqn:parts.
  destruct (quotient_ok l _ _ _ parts) as [fine ->]; [now split|].
  unfold decides in computed. rewrite parts in computed.
  cbn [fst] in computed. apply (same_ok l) in computed.
  rewrite (combined_ok l pairs relations), times_ok, product_ok in computed.
  apply Rmult_integral in computed as [zero|zero].
  - rewrite zero. field. assumption.
  - now apply (other_ok l scale) in zero.
Qed.

(** The same with a list of what is divided by: every divisor of both sides is in it, or an integer. *)
Fixpoint alike (a b : term) : bool :=
  match a, b with
  | Var p, Var q => Pos.eqb p q
  | Int x, Int y => Z.eqb x y
  | Add a b, Add c d | Mul a b, Mul c d => alike a c && alike b d
  | Opp a, Opp b | Inv a, Inv b => alike a b
  | _, _ => false
  end.

Lemma alike_ok a b : alike a b = true -> a = b.
Proof.
  revert b. induction a; destruct b; simpl; intros equal; try discriminate.
  - now apply Pos.eqb_eq in equal as ->.
  - now apply Z.eqb_eq in equal as ->.
  - apply andb_true_iff in equal as [one two]. now rewrite (IHa1 _ one), (IHa2 _ two).
  - apply andb_true_iff in equal as [one two]. now rewrite (IHa1 _ one), (IHa2 _ two).
  - now rewrite (IHa _ equal).
  - now rewrite (IHa _ equal).
Qed.

Fixpoint nonzero (l : list R) (divisors : list term) : Prop :=
  match divisors with
  | [] => True
  | divisor :: rest => value l divisor <> 0 /\ nonzero l rest
  end.

Definition safe (divisors : list term) (t : term) : bool :=
  match t with
  | Int z => negb (Z.eqb z 0)
  | _ => existsb (alike t) divisors
  end.

Fixpoint covered (divisors : list term) (t : term) : bool :=
  match t with
  | Var _ | Int _ => true
  | Add a b | Mul a b => covered divisors a && covered divisors b
  | Opp a => covered divisors a
  | Inv a => covered divisors a && safe divisors a
  end.

Lemma member_ok l divisors t : nonzero l divisors -> existsb (alike t) divisors = true -> value l t <> 0.
Proof.
  induction divisors as [|divisor rest step]; simpl; intros all found; [discriminate|].
  apply orb_true_iff in found as [this|other].
  - apply alike_ok in this as ->. apply all.
  - apply step; [apply all|assumption].
Qed.

Lemma safe_ok l divisors t : nonzero l divisors -> safe divisors t = true -> value l t <> 0.
Proof.
  intros all. destruct t; cbn [safe]; try (apply member_ok; assumption).
  intros other. simpl. apply not_0_IZR. intros ->. discriminate.
Qed.

Lemma covered_ok l divisors t : nonzero l divisors -> covered divisors t = true -> defined l t.
Proof.
  intros all. induction t; cbn [covered defined]; intros found; trivial.
  - apply andb_true_iff in found as [one two]. split; auto.
  - apply andb_true_iff in found as [one two]. split; auto.
  - auto.
  - apply andb_true_iff in found as [one two]. split; [auto|]. now apply (safe_ok l divisors).
Qed.

Definition proves (left right : term) (pairs : list (written * written)) (divisors : list term)
    (scale : list written) : bool :=
  covered divisors left && covered divisors right && decides left right pairs scale.

Theorem proved l left right pairs divisors scale :
  hold l pairs -> nonzero l divisors -> other l scale -> proves left right pairs divisors scale = true ->
  value l left = value l right.
Proof.
  intros relations others factors computed.
  apply andb_true_iff in computed as [covers computed]. apply andb_true_iff in covers as [one two].
  apply (certificate l left right pairs scale); try assumption; now apply (covered_ok l divisors).
Qed.

(** Polynomials reduced by relations that say what the square of a variable is: [(place, square)]. What is reduced to
    zero needs no cofactors. *)
Notation divided_by := (triv_div 0%Z 1%Z Zeq_bool).
Notation reduced := (PNSubstL 0%Z 1%Z Z.add Z.mul Zeq_bool divided_by).
Notation monomial := (mon_of_pol 0%Z Zeq_bool).
Notation relations_hold := (MPcond 0 1 Rplus Rmult (@eq R) IZR).

Lemma divided_ok : div_theory (@eq R) Z.add Z.mul IZR divided_by.
Proof. apply (triv_div_th Rset Rext almost integers). Qed.

Lemma monomial_ok l p m : monomial p = Some m -> IZR (fst m) * Mphi 0 1 Rmult l (snd m) = at_point l p.
Proof. intros. now apply (mon_of_pol_ok Rset Rext almost integers). Qed.

Fixpoint substitutions (squares : list (positive * written)) : list (Z * Mon * poly) :=
  match squares with
  | [] => []
  | (p, square) :: rest =>
      match monomial (times (mk_X 0%Z 1%Z p) (mk_X 0%Z 1%Z p)) with
      | Some m => (m, read square) :: substitutions rest
      | None => substitutions rest
      end
  end.

Fixpoint squared (l : list R) (squares : list (positive * written)) : Prop :=
  match squares with
  | [] => True
  | (p, square) :: rest => BinList.nth 0 p l * BinList.nth 0 p l - reading l square = 0 /\ squared l rest
  end.

Lemma substitutions_ok l squares : squared l squares -> relations_hold (substitutions squares) l.
Proof.
  induction squares as [|[p square] rest step]; cbn [squared substitutions]; intros held; [exact I|].
  destruct held as [this others].
  destruct (monomial (times (mk_X 0%Z 1%Z p) (mk_X 0%Z 1%Z p))) as [m|] eqn:found; [|now apply step].
  cbn [MPcond]. split; [|now apply step].
  rewrite (monomial_ok l _ _ found), times_ok, variable_ok, read_ok. now apply Rminus_diag_uniq.
Qed.

Definition rounds : nat := 12.

Definition vanishes (left right : term) (squares : list (positive * written)) (scale : list written) : bool :=
  same (reduced (times (fst (quotient (Add left (Opp right)))) (product (map (fun w => read w) scale)))
    (substitutions squares) rounds rounds) (constant 0%Z).

Definition reduces (left right : term) (squares : list (positive * written)) (divisors : list term)
    (scale : list written) : bool :=
  covered divisors left && covered divisors right && vanishes left right squares scale.

Theorem by_reduction l left right squares divisors scale :
  squared l squares -> nonzero l divisors -> other l scale -> reduces left right squares divisors scale = true ->
  value l left = value l right.
Proof.
  intros relations others factors computed.
  apply andb_true_iff in computed as [covers computed]. apply andb_true_iff in covers as [one two].
  apply (covered_ok l divisors left others) in one. apply (covered_ok l divisors right others) in two.
  apply Rminus_diag_uniq. change (value l (Add left (Opp right)) = 0).
  unfold vanishes in computed.
  destruct (quotient (Add left (Opp right))) as [above below] eqn:parts.
  destruct (quotient_ok l _ _ _ parts) as [fine ->]; [now split|].
  cbn [fst] in computed. apply (same_ok l) in computed.
  rewrite <- (PNSubstL_ok Rset Rext almost integers divided_ok rounds rounds _ _ l
    (substitutions_ok l squares relations)), times_ok, product_ok in computed.
  change (at_point l (constant 0%Z)) with 0 in computed.
  apply Rmult_integral in computed as [zero|zero].
  - rewrite zero. field. assumption.
  - now apply (other_ok l scale) in zero.
Qed.
