; diagnostic: label.unknown line 3
%BAD G71 *
N10 L7,0 *
N99999999 %BAD G71 *
