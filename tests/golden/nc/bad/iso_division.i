; run: failed line 4: division by zero (1 / 0)
%BAD G71 *
N10 D00 Q1 P01 +0 *
N20 D04 Q2 P01 +1 P02 +Q1 *
N99999999 %BAD G71 *
