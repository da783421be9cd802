; diagnostic: syntax.error line 4
%BAD G71 *
N10 T5 G17 S1000 *
N20 G83 P01 2 P02 -20 *
N99999999 %BAD G71 *
